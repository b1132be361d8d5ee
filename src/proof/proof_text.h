// SPDX-License-Identifier: MIT
// Text of constraints in certificates (docs/proof.md, section 2).
#pragma once

#include <string>

#include "model/instance.h"
#include "planning/constraint.h"

namespace grove::detail {

// Returns a time, or "inf" for kNever.
std::string proof_text_until(Time end);
// Returns a constraint as text, for example "3 bar 17 4 4".
std::string proof_text(const AgentConstraint& constraint, const Instance& instance);

}  // namespace grove::detail
