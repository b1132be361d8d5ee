// SPDX-License-Identifier: MIT
// Trims certificates without the instance, hence without the least costs of agents under
// constraints.
//
// The remaining proofs are valid by the rules of docs/proof.md and use only constraints and lemmas
// that they used before, or earlier lemmas that imply these. The following parts are removed:
//
// - *Splits with a redundant side.* One side of the split adds only constraints that are already
//   active. The proof below this side also proves the node, because it has the same active
//   constraints.
// - *Splits with an unused side.* If the proof below one side does not need the constraints of this
//   side, it also proves the node. A leaf that uses the costs of agents can need all active
//   constraints, and so can `joint`, `prices` and `formula`. A leaf that lemmas prove for any costs
//   of agents (lemma_table.cpp) needs only the constraints of these lemmas, and "later" only those
//   of its lemma. So a proof with only such leaves needs the union of these constraints, without
//   those that its own splits add. A side is unused if all needed constraints are active without
//   it.
//   ("rest" adds more than its own constraint: active_constraints.cpp.) If a split or lemma above
//   imposes the same constraint, the proof then needs it from there, and that split or lemma
//   remains, because needs are propagated upwards after the removals below.
// - *Constraints of a lemma* that its proof does not need, by the same argument. The lemma is then
//   stronger.
// - *Lemmas* that an earlier lemma with the same agents and constraints implies.
// - *Names* of lemmas that a leaf does not need.
// - *Rows* of `prices` with price 0.
// - Finally, each lemma that no remaining line names.
//
// It takes three passes over the file: the first decides which sides of each split to keep, the
// second records the lemmas that the remaining parts name, and the third writes.
#include "proof/certificate_trim.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input_error.h"
#include "model/assert.h"
#include "model/limits.h"
#include "proof/active_constraints.h"
#include "proof/certificate_file.h"
#include "proof/certificate_reader.h"
#include "proof/kept_parts.h"
#include "proof/lemma_table.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

using Constraints = std::vector<CertificateConstraint>;  // ascending
using Needs = std::optional<Constraints>;                // nullopt: perhaps all active constraints

Constraints united(const Constraints& a, const Constraints& b) {
  Constraints all;
  std::ranges::set_union(a, b, std::back_inserter(all));
  return all;
}

// First pass: decides which sides of each split to keep, and fills the lemma table.
class DecidingPass : public KeptParts {
 public:
  explicit DecidingPass(LemmaTable& lemmas) : lemmas_(lemmas) {}
  std::vector<Keep> keeps;  // by split
  std::int64_t lines = 0;

  void line(std::string_view /*text*/) override { ++lines; }
  void lemma(Cost bound, std::span<const AgentIndex> agents) override {
    statement_ = {{agents.begin(), agents.end()}, bound, {}, 0};
  }
  void constraint(const CertificateConstraint& of_lemma) override {
    statement_.constraints.push_back(of_lemma);
    active_.add(of_lemma);
  }
  void theorem(Cost bound) override {
    statement_ = {{}, bound, {}, 0};
    is_theorem_ = true;
  }
  void proven() override {
    GROVE_CHECK(levels_.empty(), "a proof ends after all its splits");
    if (is_theorem_) return;
    Constraints& all = statement_.constraints;
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (needs_ && std::ranges::includes(all, *needs_)) all = std::move(*needs_);
    lemmas_.add(std::move(statement_));
    active_.clear();
  }

 private:
  struct Level {
    Fork fork;
    Needs first;  // needs of its first side
  };

  Keep begin_split(std::size_t number, const Fork& fork) override {
    const Keep keep = active_.has_side(fork.sides[0])   ? Keep::kFirst
                      : active_.has_side(fork.sides[1]) ? Keep::kSecond
                                                        : Keep::kBoth;
    keeps.resize(number + 1, Keep::kBoth);
    keeps[number] = keep;
    levels_.push_back({fork, std::nullopt});
    return keep;
  }
  void begin_side(int which) override { active_.assume(levels_.back().fork.sides[which]); }

  Keep end_first_side(std::size_t number) override {
    Level& level = levels_.back();
    if (keeps[number] != Keep::kSecond) active_.undo(level.fork.sides[0]);
    if (keeps[number] != Keep::kBoth) return keeps[number];
    if (proves_node()) return keeps[number] = Keep::kFirst;
    level.first = std::move(needs_);
    return Keep::kBoth;
  }
  void end_split(std::size_t number) override {
    const Level& level = levels_.back();
    if (keeps[number] != Keep::kFirst) active_.undo(level.fork.sides[1]);
    if (keeps[number] == Keep::kBoth) {
      if (proves_node())
        keeps[number] = Keep::kSecond;
      else
        needs_ = needs_of(level);
    }
    levels_.pop_back();
  }
  // True if the proof just completed, below a side that is no longer active, also proves the node.
  bool proves_node() const {
    return needs_ && std::ranges::all_of(*needs_, [&](const CertificateConstraint& constraint) {
             return active_.has(constraint);
           });
  }
  // Returns the needs of a split that keeps both sides. needs_ holds those of its second side.
  Needs needs_of(const Level& level) const {
    if (!level.first || !needs_) return std::nullopt;
    Constraints all =
        united(without(*level.first, level.fork.sides[0]), without(*needs_, level.fork.sides[1]));
    if (!level.fork.lemma) return all;
    return united(all, lemmas_[lemmas_[*level.fork.lemma].same_as].constraints);
  }
  Constraints without(const Constraints& constraints, const CertificateConstraint& side) const {
    Constraints rest;
    std::ranges::copy_if(
        constraints, std::back_inserter(rest),
        [&](const CertificateConstraint& constraint) { return !active_.is_of(constraint, side); });
    return rest;
  }

  void kept_leaf(std::span<const LemmaNumber> named) override {
    const LemmaTable::Leaf leaf = lemmas_.leaf(named, statement_.bound);
    needs_.reset();
    if (!leaf.by_lemmas) return;
    needs_.emplace();
    for (const LemmaNumber name : leaf.names) needs_ = united(*needs_, lemmas_[name].constraints);
  }
  void kept_joint() override { needs_.reset(); }
  void kept_prices() override { needs_.reset(); }
  void kept_formula() override { needs_.reset(); }

  LemmaTable& lemmas_;
  TableLemma statement_;
  bool is_theorem_ = false;
  ActiveConstraints active_;
  std::deque<Level> levels_;
  Needs needs_;  // of the last complete proof
};

// Base of the second and third pass, which visit only the parts that the first pass keeps.
class LaterPass : public KeptParts {
 public:
  LaterPass(const LemmaTable& lemmas, const std::vector<Keep>& keeps)
      : lemmas_(lemmas), keeps_(keeps) {}

  void lemma(Cost bound, std::span<const AgentIndex> /*agents*/) override {
    bound_ = bound;
    begin_lemma(number_);
  }
  void theorem(Cost bound) override {
    bound_ = bound;
    begin_theorem();
  }
  void proven() override { ++number_; }

 protected:
  virtual void begin_lemma(LemmaNumber number) = 0;
  virtual void begin_theorem() = 0;
  virtual void kept_split(const Fork& fork) = 0;
  virtual void leaf_of(const std::vector<LemmaNumber>& names) = 0;

  LemmaNumber named(LemmaNumber lemma) const { return lemmas_[lemma].same_as; }
  const LemmaTable& lemmas_;

 private:
  Keep begin_split(std::size_t number, const Fork& fork) final {
    if (keeps_.at(number) == Keep::kBoth) kept_split(fork);
    return keeps_[number];
  }
  Keep end_first_side(std::size_t number) final { return keeps_[number]; }
  void kept_leaf(std::span<const LemmaNumber> all) final {
    leaf_of(lemmas_.leaf(all, bound_).names);
  }

  const std::vector<Keep>& keeps_;
  Cost bound_ = 0;
  LemmaNumber number_ = 0;
};

// Second pass: finds the lemmas that the theorem needs, directly or through other lemmas.
class NamingPass : public LaterPass {
 public:
  NamingPass(const LemmaTable& lemmas, const std::vector<Keep>& keeps)
      : LaterPass(lemmas, keeps), names_(lemmas.size()), needed_(lemmas.size()) {}

  // Returns, by lemma, whether the theorem needs it. Call after the whole certificate was read.
  std::vector<bool> needed() && {
    for (std::size_t lemma = needed_.size(); lemma-- > 0;)
      if (needed_[lemma])
        for (const LemmaNumber name : names_[lemma]) {
          GROVE_CHECK(static_cast<std::size_t>(name) < lemma, "a lemma names only earlier lemmas");
          needed_[name] = true;
        }
    return std::move(needed_);
  }

 private:
  void begin_lemma(LemmaNumber number) override { of_lemma_ = &names_.at(number); }
  void begin_theorem() override { of_lemma_ = nullptr; }
  void kept_split(const Fork& fork) override {
    if (fork.lemma) name(named(*fork.lemma));
  }
  void leaf_of(const std::vector<LemmaNumber>& names) override {
    for (const LemmaNumber lemma : names) name(lemma);
  }
  void name(LemmaNumber lemma) {
    if (of_lemma_ == nullptr)
      needed_[lemma] = true;
    else
      of_lemma_->push_back(lemma);
  }
  void proven() override {
    LaterPass::proven();
    if (of_lemma_ == nullptr) return;
    std::ranges::sort(*of_lemma_);
    of_lemma_->erase(std::unique(of_lemma_->begin(), of_lemma_->end()), of_lemma_->end());
    of_lemma_->shrink_to_fit();
  }

  std::vector<std::vector<LemmaNumber>> names_;  // by lemma: the lemmas that its proof names
  std::vector<bool> needed_;                     // by lemma: does the theorem need it?
  std::vector<LemmaNumber>* of_lemma_ = nullptr;
};

// Third pass: writes the parts to keep, with new numbers for the lemmas.
class WritingPass : public LaterPass {
 public:
  WritingPass(const LemmaTable& lemmas, const std::vector<Keep>& keeps,
              const std::vector<bool>& needed, CertificateOutput& output)
      : LaterPass(lemmas, keeps), needed_(needed), numbers_(needed.size()), output_(output) {
    LemmaNumber next = 0;
    for (std::size_t lemma = 0; lemma < needed.size(); ++lemma)
      if (needed[lemma]) numbers_[lemma] = next++;
  }
  std::int64_t lines = 0;

  void line(std::string_view text) override { text_ = text; }
  void head() override { put(text_); }
  void constraint(const CertificateConstraint& of_lemma) override {
    if (std::erase(constraints_, of_lemma) > 0) put(text_);
  }
  void proven() override {
    GROVE_CHECK(constraints_.empty(), "all constraints of a lemma are written");
    LaterPass::proven();
  }
  void end() override { put(text_); }

 private:
  void begin_lemma(LemmaNumber number) override {
    is_needed_ = needed_.at(number);
    constraints_ = lemmas_[number].constraints;
    put(text_);
  }
  void begin_theorem() override {
    is_needed_ = true;
    put(text_);
  }
  void kept_split(const Fork& fork) override {
    if (!fork.lemma) return put(text_);
    GROVE_CHECK(!is_needed_ || needed_[named(*fork.lemma)], "a split that is kept keeps its lemma");
    const auto& [one, other] = fork.sides;
    put(fmt::format("later {} {} {} {} {}", one.agent, one.end, other.agent, other.end,
                    numbers_[named(*fork.lemma)]));
  }
  void leaf_of(const std::vector<LemmaNumber>& names) override {
    std::string line = "leaf";
    for (const LemmaNumber name : names) {
      GROVE_CHECK(!is_needed_ || needed_[name],
                  "a line that is kept names only lemmas that are kept");
      line += fmt::format(" {}", numbers_[name]);
    }
    put(line);
  }
  void kept_joint() override { put(text_); }
  void kept_prices() override { put(text_); }
  void kept_row(std::int64_t charge) override {
    if (charge > 0) put(text_);
  }
  void kept_rows_end() override { put(text_); }
  void kept_formula() override { put(text_); }
  void kept_formula_line() override { put(text_); }
  void kept_formula_end() override { put(text_); }

  void put(std::string_view line) {
    if (!is_needed_) return;
    output_.line(line);
    ++lines;
  }

  const std::vector<bool>& needed_;
  std::vector<LemmaNumber> numbers_;  // by lemma: its new number, if it is needed
  CertificateOutput& output_;
  std::string_view text_;    // text of the current line
  bool is_needed_ = true;    // is the current lemma or theorem needed?
  Constraints constraints_;  // constraints of the lemma that are not yet written
};

// Reads the file once and returns true if it is compressed. Checks the memory limit before each
// piece of about 64 kB. Data that could grow a lot at once is stored in deques, which never copy
// all their elements.
bool walk(const fs::path& file, CertificateVisitor& visitor, const Limits& limits) {
  CertificateBytes bytes(file);
  const ByteSource source = [&](char* buffer, std::size_t size) {
    if (limits.stop_requested())
      throw InputError(file.string(), "",
                       fmt::format("needs more memory than {:.3g} GB to be trimmed; expected a "
                                   "smaller certificate, or a higher --memory-limit",
                                   static_cast<double>(*limits.memory_limit()) / 1e9));
    return bytes.read(buffer, size);
  };
  read_certificate_lines(file.string(), source, nullptr, visitor);
  return bytes.compressed();
}

}  // namespace

TrimmedCertificate trim_certificate(const fs::path& from, const fs::path& to, std::size_t memory) {
  if (fs::exists(from) && !fs::is_regular_file(from))
    throw InputError(from.string(), "", "expected a file, which can be read more than once");
  Limits limits;
  limits.set_memory_limit(memory);
  TrimmedCertificate trimmed;
  LemmaTable lemmas;
  DecidingPass deciding(lemmas);
  const bool is_compressed = walk(from, deciding, limits);
  trimmed.before = {deciding.lines, static_cast<std::int64_t>(fs::file_size(from))};
  NamingPass naming(lemmas, deciding.keeps);
  walk(from, naming, limits);
  const std::vector<bool> needed = std::move(naming).needed();
  CertificateOutput output(to, is_compressed);
  WritingPass writing(lemmas, deciding.keeps, needed, output);
  walk(from, writing, limits);
  GROVE_CHECK(writing.lines <= deciding.lines, "trimming adds no line");
  trimmed.after.lines = writing.lines;
  trimmed.after.bytes = output.commit();
  return trimmed;
}

}  // namespace grove::detail
