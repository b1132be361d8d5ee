// SPDX-License-Identifier: MIT
// Converts conflicts and constraints to text, for logs of constraint trees.
#pragma once

#include <string>

#include "conflicts/conflict.h"
#include "model/instance.h"
#include "planning/constraint.h"

namespace grove::detail {

// Returns, for example, "a1 and a4 on [3,4] at 7", where 7 is the time step.
std::string text_of(const Conflict& conflict, const Instance& instance);
// Returns, for example, "a1 not on [3,4] at 7"; "" if the constraint has no agent.
std::string text_of(const AgentConstraint& constraint, const Instance& instance);

}  // namespace grove::detail
