// SPDX-License-Identifier: MIT
// A plan from the paths of another one that some agents cannot keep.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/agent_stops_cache.h"
#include "search/problem.h"

namespace grove::detail {

// Plans the agents without a path (an empty one in `paths`, by AgentIndex) around the others, whose
// paths must be valid for `problem` and collide with none. Where there is no way around, those in
// the way of what an agent would do alone give way and are planned anew themselves: as few agents
// as need be get other paths. Proves nothing, and gives up after some tries: no plan, as when a
// limit strikes. The same seed makes the same plan, limits aside.
std::optional<Plan> repaired(const Problem& problem, AgentStopsCache& stops,
                             const std::vector<Path>& paths, std::uint64_t seed,
                             const Limits& limits);

// What the agents would cost if each were alone: no plan costs less. Of those met before a limit
// strikes, the others counting nothing.
Cost sum_of_individual_costs(const Problem& problem, AgentStopsCache& stops, const Limits& limits);

}  // namespace grove::detail
