// SPDX-License-Identifier: MIT
// Repair of a plan in which some agents can no longer keep their paths.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"

namespace grove::detail {

// Plans the agents that have no path around the agents that have one. `paths`, by AgentIndex: empty
// for an agent to be planned; the other paths must be valid for `problem` and must not collide. If
// no path is found for an agent, the agents that block its individual path are re-planned, too, and
// other agents only if that is not enough, so that few agents get new paths. Heuristic: returns
// nullopt after a number of failures, which proves nothing, or if a limit was reached.
// Deterministic: the same seed yields the same plan, unless a limit is reached.
std::optional<Plan> repaired(const Problem& problem, AgentStopsCache& stops,
                             const std::vector<Path>& paths, std::uint64_t seed,
                             const Limits& limits);

// Returns the sum of lower bounds on the agents' individual costs; no plan costs less. An agent
// that is not planned before a limit is reached counts 0.
Cost sum_of_individual_costs(const Problem& problem, AgentStopsCache& stops, const Limits& limits);

}  // namespace grove::detail
