// SPDX-License-Identifier: MIT
// Independent check of the joint oracle for two agents.
#pragma once

#include <optional>

#include "model/plan.h"

namespace grove::detail::oracle {

// Returns the optimal cost of an instance with exactly two agents, or nullopt if there is no plan.
// The instance must allow following. Slow and simple. It uses a different method from the joint
// oracle and shares only steps_on() with it.
std::optional<Cost> solve_two_agents(const Instance& instance);

}  // namespace grove::detail::oracle
