// SPDX-License-Identifier: MIT
#include "proof/certificate_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "io/input_error.h"
#include "model/parse_number.h"
#include "proof/certificate.h"
#include "proof/line_stream.h"
#include "proof/proof_text.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

constexpr std::uint64_t kTimes = std::uint64_t{1} << 31;
constexpr std::uint64_t kMaxAgents = std::uint64_t{1} << 20;  // if no instance is given
constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::size_t kSumDigits = 16;

class Reader {
 public:
  Reader(std::string file, ByteSource bytes, const Instance* instance, CertificateVisitor& visitor)
      : file_(std::move(file)),
        lines_(std::move(bytes)),
        instance_(instance),
        visitor_(visitor),
        agents_(instance ? static_cast<std::uint64_t>(instance->agent_count()) : kMaxAgents),
        places_(instance ? static_cast<std::uint64_t>(instance->world().place_count()) : kTimes),
        tasks_(instance ? static_cast<std::uint64_t>(instance->task_count()) : kTimes) {}

  void read() {
    take_head();
    take_line();
    while (one_of({"lemma", "theorem"}) == 0) take_lemma();
    const Cost proven = bound();
    end_line();
    visitor_.theorem(proven);
    take_line();
    take_proof_from_here();
    take_line();
    keyword("end");
    end_line();
    visitor_.end();
    if (lines_.next() != LineStream::Next::kNone)
      fail("found more after it", "nothing after 'end'");
  }

 private:
  // --- lines and tokens ---

  void take_line() {
    ++line_;
    switch (lines_.next()) {
      case LineStream::Next::kLine:
        break;
      case LineStream::Next::kNone:
        fail("the file ends", "a line, ended by LF");
      case LineStream::Next::kUnterminated:
        fail("the file ends within it", "a line, ended by LF");
      case LineStream::Next::kTooLong:
        fail("it is too long", fmt::format("at most {} bytes", LineStream::kMaxLineLength));
    }
    words_ = lines_.line();
    visitor_.line(lines_.line());
  }
  // One blank separates two words. Between two adjacent blanks, and after a blank at the end of the
  // line, is an empty word.
  std::optional<std::string_view> next_word() {
    if (!words_) return std::nullopt;
    const std::string_view all = *words_;
    const std::size_t end = all.find(' ');
    if (end == std::string_view::npos)
      words_.reset();
    else
      words_ = all.substr(end + 1);
    return all.substr(0, end);
  }
  [[noreturn]] void fail_at(std::optional<std::string_view> found,
                            std::string_view expected) const {
    fail(found ? fmt::format("found '{}'", one_line(*found)) : "the line ends", expected);
  }
  void end_line() {
    if (words_) fail_at(*words_, "the end of the line");
  }
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw InputError(file_, fmt::format("line {}", line_),
                     fmt::format("{}; expected {}", found, expected));
  }

  void keyword(std::string_view expected) {
    const auto found = next_word();
    if (found != expected) fail_at(found, fmt::format("'{}'", expected));
  }
  // Takes a word that must be one of `words`, and returns its index.
  int one_of(std::initializer_list<std::string_view> words) {
    const auto found = next_word();
    const auto at = found ? std::ranges::find(words, *found) : words.end();
    if (at == words.end()) fail_at(found, fmt::format("{}", fmt::join(words, " or ")));
    return static_cast<int>(at - words.begin());
  }
  std::uint64_t number(std::string_view what, std::uint64_t below) {
    const auto found = next_word();
    const auto value = found ? parse_number<std::uint64_t>(*found) : std::nullopt;
    if (value && *value < below) return *value;
    fail_at(found, below == 0 ? fmt::format("{}, of which there is none", what)
                              : fmt::format("{}, from 0 to {}", what, below - 1));
  }
  bool take_inf() {
    if (!words_ || words_->substr(0, words_->find(' ')) != "inf") return false;
    next_word();
    return true;
  }

  // --- numbers ---

  std::int32_t small(std::string_view what, std::uint64_t below) {
    return static_cast<std::int32_t>(number(what, below));
  }
  AgentIndex agent() { return small("the number of an agent", agents_); }
  std::int32_t place() { return small("the number of a place", places_); }
  std::int32_t task() { return small("the number of a task", tasks_); }
  LemmaNumber lemma() {
    return static_cast<LemmaNumber>(number("the number of an earlier lemma", lemmas_));
  }
  std::int32_t time() { return small("a time", kTimes); }
  // Takes the start and the end of a time interval.
  void span(CertificateConstraint& constraint) {
    constraint.begin = time();
    constraint.end = take_inf() ? CertificateConstraint::kForEver : small("a time or inf", kTimes);
  }
  // Takes one side of "later": an agent with a goal, and a time.
  CertificateLate late() {
    const AgentIndex whose = agent();
    if (instance_ != nullptr && !instance_->agent(whose).goal)
      fail_at(fmt::to_string(whose), "the number of an agent with a goal");
    return {whose, time()};
  }
  // Takes two agents, each followed by a time.
  void take_finish_pair() {
    agent();
    time();
    agent();
    time();
  }
  Cost bound() {
    if (take_inf()) return kInfiniteCost;
    return static_cast<Cost>(number("a cost or inf", static_cast<std::uint64_t>(kInfiniteCost)));
  }
  std::int64_t charge() {
    return static_cast<std::int64_t>(number("a price", static_cast<std::uint64_t>(kInfiniteCost)));
  }

  // --- grammar ---

  void take_head() {
    take_line();
    keyword("grove-proof");
    keyword("1");
    end_line();
    visitor_.head();
    take_line();
    keyword("instance");
    take_checksum();
    end_line();
    visitor_.head();
    take_line();
    keyword("following");
    const bool may_follow = one_of({"yes", "no"}) == 0;
    end_line();
    visitor_.head();
    visitor_.following(may_follow);
  }

  void take_checksum() {
    const auto found = next_word();
    if (instance_ == nullptr) {
      const auto is_digit = [](char c) {
        return std::string_view(kDigits).find(c) < kDigits.size();
      };
      if (!found || found->size() != kSumDigits || !std::ranges::all_of(*found, is_digit))
        fail_at(found, fmt::format("a checksum, {} digits of 0 to f", kSumDigits));
      return;
    }
    const std::string expected = fmt::format("{:016x}", certificate_checksum(*instance_));
    if (found != expected) fail_at(found, expected + ", the checksum of this instance");
  }

  // `may_rest_ever`: the time of `rest` may be inf.
  CertificateConstraint constraint(bool may_rest_ever = false) {
    using CertificateKind = CertificateConstraint::Kind;
    CertificateConstraint constraint;
    constraint.agent = agent();
    constraint.kind = static_cast<CertificateKind>(
        one_of({"bar", "move", "norest", "rest", "pass", "stop", "nostop"}));
    switch (constraint.kind) {
      case CertificateKind::kVertexOrEdge:
        constraint.p = place();
        span(constraint);
        break;
      case CertificateKind::kMove:
      case CertificateKind::kPass:
        constraint.p = place();
        constraint.q = place();
        span(constraint);
        break;
      case CertificateKind::kNoRest:
      case CertificateKind::kRest:
        constraint.p = place();
        if (may_rest_ever && constraint.kind == CertificateKind::kRest && take_inf())
          constraint.begin = constraint.end = CertificateConstraint::kForEver;
        else
          constraint.begin = constraint.end = time();
        break;
      case CertificateKind::kStop:
      case CertificateKind::kNoStop:
        constraint.p = small("the number of a stop", tasks_);
        constraint.q = task();
    }
    return constraint;
  }

  // Takes a lemma from the second word of its first line to its proof, and the line after the
  // proof.
  void take_lemma() {
    const Cost proven = bound();
    std::vector<AgentIndex> whose{agent()};
    while (words_) {
      const std::string_view rest = *words_;
      whose.push_back(agent());
      if (whose.back() <= whose[whose.size() - 2]) fail_at(rest, "agents in ascending order");
    }
    visitor_.lemma(proven, whose);
    take_line();
    while (words_->starts_with("demand ")) {
      keyword("demand");
      const std::string_view rest = *words_;
      const CertificateConstraint found = constraint();
      if (!std::ranges::binary_search(whose, found.agent))
        fail_at(rest, "a constraint on an agent of the lemma");
      end_line();
      visitor_.constraint(found);
      take_line();
    }
    take_proof_from_here();
    ++lemmas_;
    take_line();
  }

  // Takes a proof whose first line is already taken. A proof can be as deep as it is long, so the
  // code uses no recursion.
  void take_proof_from_here() {
    for (std::int64_t open = 1 + step(); open > 0; open += step()) take_line();
    visitor_.proven();
  }

  // Takes one step of a proof. Returns the change in the number of open subproofs.
  int step() {
    switch (one_of({"leaf", "split", "later", "joint", "prices", "formula", "choices"})) {
      case 0:
        named_.clear();
        while (words_) named_.push_back(lemma());
        visitor_.leaf(named_);
        return -1;
      case 1:
        take_split();
        return 1;
      case 2:
        take_later();
        return 1;
      case 3:
        end_line();
        visitor_.joint();
        return -1;
      case 4:
        end_line();
        visitor_.prices();
        take_rows();
        return -1;
      case 5:
        end_line();
        visitor_.formula();
        take_formula();
        return -1;
      default:
        end_line();
        visitor_.formula();
        take_prices_of_choices();
        take_formula();
        return -1;
    }
  }

  void take_split() {
    const CertificateConstraint one = constraint();
    keyword("|");
    const CertificateConstraint other = constraint();
    end_line();
    visitor_.split(one, other);
  }
  void take_later() {
    const CertificateLate one = late();
    const CertificateLate other = late();
    const LemmaNumber why = lemma();
    end_line();
    visitor_.later(one, other, why);
  }

  void take_rows() {
    for (;;) {
      take_line();
      switch (one_of({"place", "edge", "finish", "end"})) {
        case 0:
          place();
          time();
          break;
        case 1:
          place();
          place();
          time();
          break;
        case 2:
          take_finish_pair();
          break;
        default:
          end_line();
          return visitor_.rows_end();
      }
      const std::int64_t paid = charge();
      end_line();
      visitor_.row(paid);
    }
  }

  // Takes the lines after "choices", up to the first line of the formula.
  void take_prices_of_choices() {
    for (;;) {
      take_line();
      const int kind = one_of({"task", "goal", "formula"});
      if (kind == 0) task();
      if (kind == 1) place();
      if (kind < 2) number("a price", kTimes);
      end_line();
      visitor_.formula_line();
      if (kind == 2) return;
    }
  }

  // Takes a formula after its first line.
  void take_formula() {
    variables_ = sums_ = clauses_ = 0;
    for (;;) {
      take_line();
      if (take_definition()) continue;
      break;
    }
    while (take_formula_step()) take_line();
    visitor_.formula_end();
  }

  // Takes a definition. Returns false, and takes nothing, if the line is something else.
  bool take_definition() {
    const std::string_view word = words_->substr(0, words_->find(' '));
    const auto* const found = std::ranges::find(kFormulaWords, word);
    if (word.empty() || found == kFormulaWords.end()) return false;
    const auto kind = static_cast<FormulaKind>(found - kFormulaWords.begin());
    if (is_step(kind) || kind < FormulaKind::kAgent) return false;
    next_word();
    take_meaning(kind);
    end_line();
    if (kind >= FormulaKind::kWithin && kind <= FormulaKind::kCount) ++variables_;
    if (kind == FormulaKind::kSum) ++sums_;
    visitor_.formula_line();
    return true;
  }

  void take_meaning(FormulaKind kind) {
    switch (kind) {
      case FormulaKind::kActive:
        agent();
        return;
      case FormulaKind::kVisit:
      case FormulaKind::kLast:
        agent();
        place();
        time();
        return;
      case FormulaKind::kRests:
        agent();
        place();
        if (!take_inf()) time();
        return;
      case FormulaKind::kNode:
        return take_node();
      case FormulaKind::kMeets:
        constraint(true);
        return;
      case FormulaKind::kCounts:
      case FormulaKind::kSkips:
        agent();
        task();
        return;
      case FormulaKind::kUsed:
        place();
        number("a unit of a price", kTimes);
        return;
      case FormulaKind::kAtMost:
        number("the number of an earlier sum", sums_);
        number("a number of inputs", kTimes);
        return;
      case FormulaKind::kInside:
      case FormulaKind::kEnds:
        agent();
        place();
        place();
        time();
        return;
      case FormulaKind::kCount:
        number("the number of an earlier sum", sums_);
        for (int left = 3; left > 0; --left) number("a number of inputs", kTimes);
        return;
      case FormulaKind::kSum:
        do literal();
        while (words_);
        return;
      case FormulaKind::kSplit:
        literal();
        literal();
        return;
      default:
        agent();
        number("an excess", kTimes);
    }
  }

  void take_node() {
    agent();
    time();
    place();
    number("the number of a pose", kTimes);
    number("a set of stops", std::numeric_limits<std::uint64_t>::max());
    if (words_ && words_->starts_with("work ")) {
      keyword("work");
      task();
      number("a number of steps", kTimes);
    }
    if (!words_) return;
    keyword("since");
    time();
    if (words_ == "end") keyword("end");
  }

  // Takes a variable of the formula, or its negation.
  void literal() {
    if (words_ && words_->starts_with('-')) words_ = words_->substr(1);
    const auto found = next_word();
    const auto value = found ? parse_number<std::uint64_t>(*found) : std::nullopt;
    if (!value || *value < 1 || *value > variables_)
      fail_at(found, "the number of an earlier variable, or its negation");
  }

  // Takes a step of a formula. Returns false if it is its end.
  bool take_formula_step() {
    switch (one_of({"clause", "drop", "core", "end"})) {
      case 0:
        while (words_) literal();
        ++clauses_;
        break;
      case 1:
        number("the number of an earlier clause", clauses_);
        break;
      case 2:
        number("the number of a sum", sums_);
        break;
      default:
        end_line();
        return false;
    }
    end_line();
    visitor_.formula_line();
    return true;
  }

  const std::string file_;
  LineStream lines_;
  const Instance* const instance_;
  CertificateVisitor& visitor_;
  const std::uint64_t agents_, places_, tasks_;  // numbers in the instance, or limits
  std::optional<std::string_view> words_;        // remainder of the line; nullopt: no word left
  std::vector<LemmaNumber> named_;
  std::int64_t line_ = 0;
  std::uint64_t lemmas_ = 0;     // lemmas read so far
  std::uint64_t variables_ = 0;  // of the current formula, as the next two
  std::uint64_t sums_ = 0;
  std::uint64_t clauses_ = 0;
};

}  // namespace

void read_certificate_lines(const std::string& file, ByteSource bytes, const Instance* instance,
                            CertificateVisitor& visitor) {
  Reader(file, std::move(bytes), instance, visitor).read();
}

}  // namespace grove::detail
