// SPDX-License-Identifier: MIT
// What a run ends with: a status, perhaps a plan, always a bound (docs/design.md, section 5).
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

// The state an agent is in at times 0, 1, ...: path[0] is its start and it stays in path.back() for
// ever.
using Path = std::vector<State>;

// The state of an agent with this path (not empty) at `time`.
inline State state_at(const Path& path, Time time) {
  GROVE_ASSERT(!path.empty() && time >= 0, "an agent is somewhere from time 0 on");
  return time < static_cast<Time>(path.size()) ? path[time] : path.back();
}
// The place it is on then.
inline Place place_at(const World& world, const Path& path, Time time) {
  return world.place(state_at(path, time));
}
// When it came to the place where it stays for ever; the path may go on there.
Time last_arrival(const World& world, const Path& path);

// An agent's being at work on a task that takes time, from `begin` to `end`; begun before time 0 if
// the agent starts at work.
struct WorkTime {
  TaskIndex task = -1;
  Time begin = 0;
  Time end = 0;
  friend bool operator==(const WorkTime&, const WorkTime&) = default;
};

struct AgentPlan {
  Time cost = 0;                    // when it comes to rest for ever with its tasks visited
  std::vector<TaskIndex> sequence;  // all its tasks, in an order in which the path visits them
  Path path;                        // base states only (world.h), up to the cost
  std::vector<WorkTime> work = {};  // in order of time
};

// The plan of an agent that walks this path, its states at work included, and may rest at its end.
// It rests as soon as it may: turns that serve nothing are left out. `stops`: a sequence that it
// realizes, as positions in Agent::stops.
AgentPlan agent_plan(const Instance& instance, AgentIndex agent,
                     std::span<const std::uint8_t> stops, const Path& path);
// And back: the path that it walks until it finishes. The plan must be a valid one.
Path walked_path(const Instance& instance, AgentIndex agent, const AgentPlan& plan);

struct Plan {
  Cost cost = 0;                  // sum of the agents' costs
  std::vector<AgentPlan> agents;  // by AgentIndex
};

// Everybody stays where it starts, for as long as nobody has a plan.
Plan standing_plan(const Instance& instance);

enum class Status : std::uint8_t {
  kOptimal,     // a plan, and its cost equals the lower bound
  kBounded,     // a plan, and cost <= (1 + w) * lower bound
  kFeasible,    // a plan, outside w
  kInfeasible,  // proven: no plan exists
  kUnknown,     // no plan when a limit struck
};

std::string_view to_string(Status status);
std::optional<Status> parse_status(std::string_view text);

// The status that a plan of `cost` (none: no plan) and a proven bound deserve.
Status status_of(std::optional<Cost> cost, Cost lower_bound, Omega omega);

// Numbers about a run, by name; the plan file's "stats". Units are in the names (wall_s).
struct Stats {
  std::map<std::string, std::int64_t> counts;
  std::map<std::string, double> measures;
  std::map<std::string, std::string> texts;
};

struct Solution {
  Status status = Status::kUnknown;
  std::optional<Plan> plan;
  Cost lower_bound = 0;  // proven: no plan costs less. 0 and meaningless when infeasible
  Omega omega;
  bool may_follow = true;  // false: what is claimed is of an instance without following
  Stats stats;
};

}  // namespace grove::detail
