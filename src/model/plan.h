// SPDX-License-Identifier: MIT
// Result of a run: a status, a lower bound, and a plan if one was found (docs/design.md, section
// 5).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/assert.h"
#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

// The states of an agent at times 0, 1, ...: path[0] is its start, and it stays in path.back() for
// ever.
using Path = std::vector<State>;

// The state of an agent with this path at `time`. Precondition: the path is not empty.
inline State state_at(const Path& path, Time time) {
  GROVE_ASSERT(!path.empty() && time >= 0, "an agent is somewhere from time 0 on");
  return time < static_cast<Time>(path.size()) ? path[time] : path.back();
}
// The place of the agent at `time`.
inline Place place_at(const World& world, const Path& path, Time time) {
  return world.place(state_at(path, time));
}
// The time at which the agent arrives at its last place, where it stays for ever. The path may
// continue on this place, for example with turns.
Time last_arrival(const World& world, const Path& path);

// The interval from `begin` to `end` in which an agent works on a task that takes time. `begin` is
// negative if the agent starts at work.
struct WorkTime {
  TaskIndex task = -1;
  Time begin = 0;
  Time end = 0;
  friend bool operator==(const WorkTime&, const WorkTime&) = default;
};

struct AgentPlan {
  Time cost = 0;                    // finish time: when it rests for ever with its tasks visited
  std::vector<TaskIndex> sequence;  // all its tasks, in an order in which the path visits them
  Path path;                        // base states only (world.h), up to time `cost`
  std::vector<WorkTime> work = {};  // in order of time
};

// The plan of an agent that follows this path. The path may contain states of work, and the agent
// may rest at its end. The agent rests as soon as it may: turns without a purpose are omitted.
// `stops`: a sequence that the path realizes, as positions in Agent::stops.
AgentPlan agent_plan(const Instance& instance, AgentIndex agent,
                     std::span<const std::uint8_t> stops, const Path& path);
// The same if only the path is known: the stops are ordered by their first visits. If the agent
// rests on its last stop, the stop at the end of the path comes last. Precondition: the path ends
// at rest with every task visited.
AgentPlan plan_of_path(const Instance& instance, AgentIndex agent, const Path& path);
// The inverse: the path of the agent, with states of work, until it finishes. Precondition: `plan`
// is valid.
Path walked_path(const Instance& instance, AgentIndex agent, const AgentPlan& plan);

struct Plan {
  Cost cost = 0;                  // sum of the agents' costs
  std::vector<AgentPlan> agents;  // by AgentIndex
};

// The plan in which every agent stays on its start. Used while there is no plan.
Plan standing_plan(const Instance& instance);

enum class Status : std::uint8_t {
  kOptimal,     // a plan, and its cost equals the lower bound
  kBounded,     // a plan, and cost <= (1 + w) * lower bound
  kFeasible,    // a plan, and cost > (1 + w) * lower bound
  kInfeasible,  // proven: no plan exists
  kUnknown,     // no plan when a limit was reached
};

std::string_view to_string(Status status);
std::optional<Status> parse_status(std::string_view text);

// The status that follows from a plan's cost (nullopt: no plan) and a proven lower bound.
Status status_of(std::optional<Cost> cost, Cost lower_bound, Omega omega);

// Statistics of a run by name: "stats" of the plan file. Names include units (wall_s).
struct Stats {
  std::map<std::string, std::int64_t> counts;
  std::map<std::string, double> measures;
  std::map<std::string, std::string> texts;
};

struct Solution {
  Status status = Status::kUnknown;
  std::optional<Plan> plan;
  Cost lower_bound = 0;  // proven: no plan costs less; meaningless (0) if infeasible
  Omega omega;
  bool may_follow = true;  // false: the claims hold for the instance without following
  Stats stats;
};

}  // namespace grove::detail
