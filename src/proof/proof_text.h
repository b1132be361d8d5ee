// SPDX-License-Identifier: MIT
// Text of constraints, splits, rows and costs in certificates.
#pragma once

#include <string>

#include "conflicts/conflict.h"
#include "model/instance.h"
#include "model/omega.h"
#include "planning/constraint.h"
#include "search/proof_log.h"

namespace grove::detail {

// "3 bar 17 4 4"
std::string proof_text(const AgentConstraint& demand, const Instance& instance);
// "split 3 bar 17 4 4 | 5 bar 17 4 4"
std::string proof_text(const Split& split, const Instance& instance);
// "place 17 4 512"
std::string proof_text(const RowMultiplier& row);
// A number, or "inf".
std::string proof_text(Cost cost);

}  // namespace grove::detail
