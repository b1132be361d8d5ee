// SPDX-License-Identifier: MIT
// Least cost of an agent without the other agents.
#pragma once

#include "model/limits.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The least cost of a path of the agent; only a lower bound if a limit was reached. Widens the
// costs to go until they contain a sequence of that cost.
Time least_cost(SequenceStages& goals, const Limits& limits);

}  // namespace grove::detail
