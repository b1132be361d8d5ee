// SPDX-License-Identifier: MIT
// Makes a certificate from proof logs in three passes.
//
// 1. The first pass reads all logs and computes for each node the bound that it proves. This bound
// is the maximum of three values: the sum of the least costs of its agents; this sum plus the
// excess that lemmas prove; and the lesser of the bounds of its two branches (proof_records.h,
// split_tree.h).
//
// 2. The second pass descends from the roots as far as the bound requires (proof_forest.h), and
// collects the lemmas that the leaves need. From the lemmas that a leaf could name, it removes each
// one without which the others suffice, first those that no earlier leaf needs.
//
// 3. The third pass writes the needed lemmas and the trees.
//
// Soundness does not depend on this code: a checker verifies the result.
#include "proof/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "conflicts/conflict.h"
#include "model/assert.h"
#include "model/instance.h"
#include "model/omega.h"
#include "planning/constraint.h"
#include "proof/certificate_file.h"
#include "proof/formula_writer.h"
#include "proof/proof_forest.h"
#include "proof/proof_parts.h"
#include "proof/proof_records.h"
#include "proof/proof_text.h"
#include "proof/split_tree.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

// Returns the line of a split, for example "split 3 bar 17 4 4 | 5 bar 17 4 4".
std::string proof_text(const Split& split, const Instance& instance) {
  return fmt::format("split {} | {}", proof_text(split[0], instance),
                     proof_text(split[1], instance));
}

// Returns the line of a row, for example "place 17 4 512".
std::string proof_text(const RowMultiplier& charged) {
  const auto& [row, charge] = charged;
  switch (row.kind) {
    case RelaxedRow::Kind::kPlace:
      return fmt::format("place {} {} {}", row.a, row.time, charge);
    case RelaxedRow::Kind::kEdge:
      return fmt::format("edge {} {} {} {}", row.a, row.b, row.time, charge);
    case RelaxedRow::Kind::kFinish:
      return fmt::format("finish {} {} {} {} {}", row.a, row.time, row.b, row.time_b, charge);
  }
  return {};
}

// Returns a number, or "inf" for kInfiniteCost.
std::string proof_text(Cost cost) {
  return cost >= kInfiniteCost ? "inf" : fmt::to_string(cost);
}

// Selects the lemmas that each leaf names, and collects all needed lemmas.
class LemmaCollector : public ForestVisitor {
 public:
  explicit LemmaCollector(Cost bound) : bound_(bound) {}
  std::unordered_set<ProofKey> needed;

  void leaf(ProofEntry* entry) override {
    if (entry == nullptr) return;
    std::vector<ProofExcess>& chosen = entry->excesses;
    std::ranges::stable_partition(
        chosen, [&](const ProofExcess& excess) { return needed.contains(excess.lemma); });
    remove_redundant(chosen, bound_ - entry->cost);
    for (const ProofExcess& excess : chosen) needed.insert(excess.lemma);
  }
  void split(const ProofEntry& entry) override {
    if (entry.split->lemma != kNoProof) needed.insert(entry.split->lemma);
  }
  void split(const Split& /*on_sequence*/) override {}

 private:
  const Cost bound_;
};

// Writes the needed lemmas of a proof log, and numbers them.
class LemmaWriter : public ProofLog {
 public:
  // All arguments must outlive this object.
  LemmaWriter(const Instance& instance, const std::unordered_set<ProofKey>& needed,
              CertificateOutput& output)
      : instance_(instance), needed_(needed), output_(output) {}

  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override {
    const ProofKey key = lemma.key();
    if (!needed_.contains(key)) return;
    if (!numbers_.emplace(key, std::ssize(numbers_)).second) return;
    output_.line(fmt::format("lemma {} {}", proof_text(lemma.bound), fmt::join(lemma.agents, " ")));
    for (const AgentConstraint& constraint : lemma.constraints)
      output_.line("demand " + proof_text(constraint, instance_));
    if (splits.empty()) return output_.line("joint");
    ProofEntries entries;
    for (const ProofSplit& split : splits) entries[split.node].split = split;
    SplitTree tree(entries);
    tree.value(root, 0);
    tree.walk(
        root, 0, lemma.bound, [&](const ProofEntry*) { output_.line("leaf"); },
        [&](const ProofEntry& entry) { output_.line(proof_text(entry.split->split, instance_)); });
  }

  void tree(const ProofTree& /*tree*/) override {}
  void split(const ProofSplit& /*split*/) override {}
  void bound(ProofKey /*node*/, Cost /*cost*/, Cost /*bound*/,
             std::span<const ProofExcess> /*excesses*/) override {}
  void prices(Cost /*bound*/, std::span<const RowMultiplier> /*rows*/) override {}
  void joint(Cost /*bound*/) override {}
  void formula(FormulaKind /*kind*/, std::span<const std::int64_t> /*numbers*/) override {}
  void formula_bound(Cost /*bound*/) override {}

  std::int64_t number(ProofKey key) const {
    GROVE_CHECK(numbers_.contains(key), "a lemma is written before it is named");
    return numbers_.at(key);
  }
  std::int64_t count() const { return std::ssize(numbers_); }

 private:
  const Instance& instance_;
  const std::unordered_set<ProofKey>& needed_;
  CertificateOutput& output_;
  std::unordered_map<ProofKey, std::int64_t> numbers_;
};

// Writes the lines of the proof of the theorem, and counts splits and leaves.
class TreeWriter : public ForestVisitor {
 public:
  TreeWriter(const Instance& instance, const LemmaWriter& lemmas, CertificateOutput& output,
             Certificate& made)
      : instance_(instance), lemmas_(lemmas), output_(output), made_(made) {}

  void leaf(ProofEntry* entry) override {
    ++made_.leaves;
    std::string line = "leaf";
    if (entry != nullptr)
      for (const ProofExcess& excess : entry->excesses)
        line += fmt::format(" {}", lemmas_.number(excess.lemma));
    output_.line(line);
  }
  void split(const ProofEntry& entry) override {
    const ProofSplit& s = *entry.split;
    if (s.lemma == kNoProof) return split(s.split);
    ++made_.splits;
    output_.line(fmt::format("later {} {} {} {} {}", s.split[0].agent, s.split[0].constraint.end,
                             s.split[1].agent, s.split[1].constraint.end, lemmas_.number(s.lemma)));
  }
  void split(const Split& split) override {
    ++made_.splits;
    output_.line(proof_text(split, instance_));
  }

 private:
  const Instance& instance_;
  const LemmaWriter& lemmas_;
  CertificateOutput& output_;
  Certificate& made_;
};

class CertificateBuilder {
 public:
  CertificateBuilder(const Instance& instance, std::span<const std::filesystem::path> parts)
      : instance_(instance), parts_(parts), forest_(written_) {
    for (const auto& part : parts_) {
      const Cost before = written_.of_formula;
      read_proof_part(part, written_);
      if (written_.of_formula > before) formula_part_ = part;
    }
    written_.drop_records_without_lemmas();
  }

  Certificate write(Cost claimed, const std::filesystem::path& file) {
    const Cost of_trees = instance_.has_choices() ? 0 : forest_.value(claimed);
    made_.bound = std::min(claimed, std::max({of_trees, written_.pricing_bound,
                                              written_.joint_bound, written_.of_formula}));
    const bool by_trees =
        of_trees >= made_.bound && !is_evidently_infeasible(claimed) && !instance_.has_choices();
    LemmaCollector choosing(made_.bound);
    if (by_trees) forest_.visit(made_.bound, choosing);
    CertificateOutput output(file, true);
    output.line("grove-proof 1");
    output.line(fmt::format("instance {:016x}", certificate_checksum(instance_)));
    output.line(instance_.may_follow() ? "following yes" : "following no");
    LemmaWriter lemmas(instance_, choosing.needed, output);
    for (const auto& part : parts_) read_proof_part(part, lemmas);
    GROVE_CHECK(lemmas.count() == std::ssize(choosing.needed),
                "all needed lemmas are written once");
    output.line("theorem " + proof_text(made_.bound));
    TreeWriter writing(instance_, lemmas, output, made_);
    if (by_trees)
      forest_.visit(made_.bound, writing);
    else if (instance_.has_choices())
      write_choices(output);
    else if (written_.pricing_bound >= made_.bound)
      write_prices(output);
    else if (written_.of_formula >= made_.bound)
      write_formula(instance_, formula_part_, made_.bound, output);
    else
      write_joint(output);
    GROVE_CHECK(!by_trees || made_.leaves == made_.splits + 1,
                "a proof by trees has one leaf more than splits");
    output.line("end");
    made_.lemmas = lemmas.count();
    made_.bytes = output.commit();
    return made_;
  }

 private:
  // True if Grove proved the instance infeasible before any search. The log does not contain the
  // reason, so the proof is `joint`, for which a checker searches all joint paths.
  bool is_evidently_infeasible(Cost claimed) const {
    return claimed >= kInfiniteCost && written_.trees.empty();
  }

  void write_joint(CertificateOutput& output) {
    output.line("joint");
    made_.by_joint_search = true;
  }

  // Without a logged formula, writes one that proves the bound 0.
  void write_choices(CertificateOutput& output) const {
    if (!formula_part_.empty()) return write_formula(instance_, formula_part_, made_.bound, output);
    for (const char* line : {"choices", "formula", "end"}) output.line(line);
  }

  void write_prices(CertificateOutput& output) const {
    output.line("prices");
    for (const RowMultiplier& row : written_.priced_rows) output.line(proof_text(row));
    output.line("end");
  }

  const Instance& instance_;
  const std::span<const std::filesystem::path> parts_;
  ProofRecords written_;
  std::filesystem::path formula_part_;  // the log with the formula of the greatest bound
  ProofForest forest_;
  Certificate made_;
};

}  // namespace

Certificate write_certificate(const Instance& instance,
                              std::span<const std::filesystem::path> parts, Cost claimed,
                              const std::filesystem::path& file) {
  return CertificateBuilder(instance, parts).write(claimed, file);
}

}  // namespace grove::detail
