// SPDX-License-Identifier: MIT
// Repair: a plan from the paths of another plan that some agents cannot keep.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/agent_stops_cache.h"
#include "search/problem.h"

namespace grove::detail {

// Plans the agents without a path around the others. `paths`, by AgentIndex: empty for these
// agents; the other paths must be valid for `problem` and must not collide. If an agent finds no
// path, the agents that block its individual path are re-planned too, so that few agents get other
// paths. Heuristic: returns nullopt after a number of failures, which proves nothing, or if a limit
// was reached. Deterministic: the same seed makes the same plan, limits excepted.
std::optional<Plan> repaired(const Problem& problem, AgentStopsCache& stops,
                             const std::vector<Path>& paths, std::uint64_t seed,
                             const Limits& limits);

// Sum of lower bounds on the agents' individual costs: no plan costs less. Agents that are not
// planned before a limit is reached count 0.
Cost sum_of_individual_costs(const Problem& problem, AgentStopsCache& stops, const Limits& limits);

}  // namespace grove::detail
