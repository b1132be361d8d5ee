// SPDX-License-Identifier: MIT
// Cost matrix that takes into account from when on places are barred for ever.
#pragma once

#include <optional>

#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// Lower bounds on the legs of every path under these intervals that visits the stops in the order
// of a sequence of plain cost `least_cost` or more. Returns nullopt if no entry exceeds the plain
// matrix. O(stops * states).
std::optional<CostMatrix> late_cost_matrix(const World& world, SafeIntervals& intervals,
                                           const AgentStops& stops, Time least_cost);

}  // namespace grove::detail
