// SPDX-License-Identifier: MIT
// Conflicts and constraints of constraint trees as text.
#pragma once

#include <string>

#include "conflicts/conflict.h"
#include "model/instance.h"
#include "planning/constraint.h"

namespace grove::detail {

// "a1 and a4 on [3,4] at 7".
std::string text_of(const Conflict& conflict, const Instance& instance);
// "a1 not on [3,4] at 7"; "" without an agent.
std::string text_of(const AgentConstraint& constraint, const Instance& instance);

}  // namespace grove::detail
