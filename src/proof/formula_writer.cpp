// SPDX-License-Identifier: MIT
#include "proof/formula_writer.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "model/assert.h"
#include "proof/proof_parts.h"
#include "proof/proof_text.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

using Numbers = std::span<const std::int64_t>;

// Visits the formula of a log.
class FormulaReader : public ProofLog {
 public:
  void tree(const ProofTree& /*tree*/) final {}
  void split(const ProofSplit& /*split*/) final {}
  void bound(ProofKey /*node*/, Cost /*cost*/, Cost /*bound*/,
             std::span<const ProofExcess> /*excesses*/) final {}
  void lemma(const ProofLemma& /*lemma*/, ProofKey /*root*/,
             std::span<const ProofSplit> /*splits*/) final {}
  void prices(Cost /*bound*/, std::span<const RowMultiplier> /*rows*/) final {}
  void joint(Cost /*bound*/) final {}
};

// Numbers the lines of the formula, and finds the first and the last line that prove a bound.
class FormulaRange : public FormulaReader {
 public:
  explicit FormulaRange(Cost bound) : bound_(bound) {}
  std::int64_t first = 0;
  std::int64_t end = -1;

  void formula(FormulaKind kind, Numbers /*numbers*/) override {
    if (end < 0 && kind == FormulaKind::kBegin) first = lines_;
    ++lines_;
  }
  void formula_bound(Cost bound) override {
    if (end < 0 && bound >= bound_) end = lines_;
  }

 private:
  const Cost bound_;
  std::int64_t lines_ = 0;
};

// The parts of a formula, in the order in which they are written.
enum class FormulaPart : std::uint8_t { kPrices, kDefinitions, kSteps };

FormulaPart part_of(FormulaKind kind) {
  if (kind < FormulaKind::kAgent) return FormulaPart::kPrices;
  return is_step(kind) ? FormulaPart::kSteps : FormulaPart::kDefinitions;
}

// Writes one part of the formula in a range of lines.
class FormulaWriter : public FormulaReader {
 public:
  FormulaWriter(const Instance& instance, const FormulaRange& range, FormulaPart part,
                CertificateOutput& output)
      : instance_(instance), range_(range), part_(part), output_(output) {}

  void formula(FormulaKind kind, Numbers numbers) override {
    const std::int64_t line = lines_++;
    if (line < range_.first || line >= range_.end || kind == FormulaKind::kBegin) return;
    if (part_of(kind) == part_) output_.line(text(kind, numbers));
  }
  void formula_bound(Cost /*bound*/) override {}

 private:
  std::string text(FormulaKind kind, Numbers numbers) const {
    switch (kind) {
      case FormulaKind::kRests:
        return fmt::format("rests {} {} {}", numbers[0], numbers[1],
                           proof_text_until(static_cast<Time>(numbers[2])));
      case FormulaKind::kNode:
        return node_text(numbers);
      case FormulaKind::kMeets:
        return "meets " + constraint_text(numbers);
      default: {
        std::string line(formula_word(kind));
        for (const std::int64_t number : numbers) line += fmt::format(" {}", number);
        return line;
      }
    }
  }

  static std::string node_text(Numbers numbers) {
    std::string line = fmt::format("node {} {} {} {} {}", numbers[0], numbers[1], numbers[2],
                                   numbers[3], numbers[4]);
    if (numbers[5] >= 0) line += fmt::format(" work {} {}", numbers[5], numbers[6]);
    if (numbers[7] >= 0) line += fmt::format(" since {}", numbers[7]);
    if (numbers[8] != 0) line += " end";
    return line;
  }

  std::string constraint_text(Numbers numbers) const {
    const auto small = [&](std::size_t i) { return static_cast<std::int32_t>(numbers[i]); };
    const auto kind = constraint_kind(static_cast<std::uint8_t>(numbers[5]));
    GROVE_CHECK(kind.has_value(), "a constraint has a kind");
    return proof_text(AgentConstraint{small(0), {small(1), small(2), small(3), small(4), *kind}},
                      instance_);
  }

  const Instance& instance_;
  const FormulaRange& range_;
  const FormulaPart part_;
  CertificateOutput& output_;
  std::int64_t lines_ = 0;
};

}  // namespace

void write_formula(const Instance& instance, const std::filesystem::path& part, Cost bound,
                   CertificateOutput& output) {
  FormulaRange range(bound);
  read_proof_part(part, range);
  GROVE_CHECK(range.end >= 0, "the log proves the bound");
  const auto write = [&](FormulaPart of_formula) {
    FormulaWriter writer(instance, range, of_formula, output);
    read_proof_part(part, writer);
  };
  if (instance.has_choices()) {
    output.line("choices");
    write(FormulaPart::kPrices);
  }
  output.line("formula");
  write(FormulaPart::kDefinitions);
  write(FormulaPart::kSteps);
  output.line("end");
}

}  // namespace grove::detail
