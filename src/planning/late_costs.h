// SPDX-License-Identifier: MIT
// What legs cost once cells are barred for ever.
#pragma once

#include <optional>

#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// Legs that every path under these intervals takes at least, if it is on the stops in the order of
// a sequence that costs `least_cost` or more by the plain matrix. None: that is the plain matrix.
// O(stops * cells).
std::optional<CostMatrix> late_cost_matrix(const World& world, SafeIntervals& intervals,
                                           const AgentStops& stops, Time least_cost);

}  // namespace grove::detail
