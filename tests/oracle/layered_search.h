// SPDX-License-Identifier: MIT
// Independent check of the joint oracle, for two agents.
#pragma once

#include <optional>

#include "model/plan.h"

namespace grove::detail::oracle {

// The optimal cost of an instance with exactly two agents. Returns nullopt if there is no plan.
// Slow and simple. It uses another method than the joint oracle and shares no code with its search.
std::optional<Cost> solve_two_agents(const Instance& instance);

}  // namespace grove::detail::oracle
