// SPDX-License-Identifier: MIT
// A second opinion for the oracle, for two agents.
#pragma once

#include <optional>

#include "model/plan.h"

namespace grove::detail::oracle {

// The optimal cost of an instance with exactly two agents; none when there is no plan. Slow, plain,
// and built on another idea than the joint oracle, with which it shares no text.
std::optional<Cost> solve_two_agents(const Instance& instance);

}  // namespace grove::detail::oracle
