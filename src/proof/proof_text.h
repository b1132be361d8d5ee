// SPDX-License-Identifier: MIT
// Text of constraints and formulas in certificates (docs/proof.md, sections 2 and 4.1).
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "model/instance.h"
#include "planning/constraint.h"
#include "search/proof_log.h"

namespace grove::detail {

// The first words of the lines of a formula, by FormulaKind; kBegin has no line.
inline constexpr std::array<std::string_view, static_cast<std::size_t>(kLastFormulaKind) + 1>
    kFormulaWords = {"",      "task", "goal",  "agent",  "within", "active", "visit",  "last",
                     "rests", "node", "meets", "counts", "skips",  "used",   "inside", "ends",
                     "count", "sum",  "split", "atmost", "clause", "drop",   "core"};
inline std::string_view formula_word(FormulaKind kind) {
  return kFormulaWords[static_cast<std::size_t>(kind)];
}

// Returns a time, or "inf" for kNever.
std::string proof_text_until(Time end);
// Returns a constraint as text, for example "3 bar 17 4 4".
std::string proof_text(const AgentConstraint& constraint, const Instance& instance);

}  // namespace grove::detail
