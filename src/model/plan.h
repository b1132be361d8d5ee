// SPDX-License-Identifier: MIT
// Paths, plans, and the result of a run: status, lower bound and, if one was found, a plan
// (docs/design.md, section 5).
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

// The states of an agent at times 0, 1, ...: path[0] is its start, and after the end of the path
// the agent stays in path.back() forever.
using Path = std::vector<State>;

// The state at `time` of an agent with this path. Preconditions: the path is not empty, and time >=
// 0.
inline State state_at(const Path& path, Time time) {
  GROVE_ASSERT(!path.empty() && time >= 0, "a path is not empty");
  return time < static_cast<Time>(path.size()) ? path[time] : path.back();
}
// The place at `time` of an agent with this path. The preconditions are those of state_at().
inline Place place_at(const World& world, const Path& path, Time time) {
  return world.place(state_at(path, time));
}
// The earliest time from which the agent stays on its last place forever. The path may continue on
// this place, for example with turns. Precondition: the path is not empty.
Time last_arrival(const World& world, const Path& path);

// The execution of a task that takes time, from time `begin` to `end` = `begin` + duration. `begin`
// is negative if the agent starts at work with at least one step done.
struct WorkTime {
  TaskIndex task = -1;
  Time begin = 0;
  Time end = 0;
  friend bool operator==(const WorkTime&, const WorkTime&) = default;
};

struct AgentPlan {
  Time cost = 0;  // finish time: the agent then rests forever, with all tasks visited
  std::vector<TaskIndex> sequence;  // all tasks, in an order in which the path visits them
  Path path;                        // base states only (world.h), up to time `cost`
  std::vector<WorkTime> work = {};  // in order of time
};

// Converts a path with states at work into the agent's plan. Precondition: the agent may rest at
// the end of the path. In the plan the agent rests as soon as it may, so turns at the end that are
// not needed are omitted. `stops`: a sequence of the agent's stops (positions in Agent::stops) that
// the path realizes.
AgentPlan agent_plan(const Instance& instance, AgentIndex agent,
                     std::span<const std::uint8_t> stops, const Path& path);
// As agent_plan(), for an agent that may choose tasks. `visits`: the tasks that the path visits, in
// the order of the visits, with at least the stops of the agent. States each visit that has to be
// stated, as early as possible. The plan of an agent without a destination can end
// within a turn.
AgentPlan agent_plan_of_visits(const Instance& instance, AgentIndex agent,
                               std::span<const TaskIndex> visits, const Path& path);
// As agent_plan(), but derives the sequence from the path: stops are ordered by their first visits.
// If the agent rests on its last stop, the stop at the end of the path comes last. Precondition:
// all tasks are visited, and the agent may rest at the end of the path.
AgentPlan plan_of_path(const Instance& instance, AgentIndex agent, const Path& path);
// The inverse of plan_of_path(): the path until the agent finishes, with states at work. However,
// it moves each task execution within a turn back to the last earlier pose that is not within a
// turn or is the agent's start. Precondition: `plan` is valid.
Path walked_path(const Instance& instance, AgentIndex agent, const AgentPlan& plan);

// The time at which `plan` states the end of the visit to `task`; without a statement, the first
// time on its place. Precondition: the agent visits the task.
Time visit_time(const Instance& instance, const AgentPlan& plan, TaskIndex task);

// If the agent rests on the last stop of its sequence, moves the tasks on its last place to the end
// of the sequence. They may be earlier in the sequence if the path visits that place several times.
// Changes nothing if the plan states visits, because these have their times.
void end_on_the_place_of_rest(const Instance& instance, AgentIndex agent, AgentPlan& plan);

struct Plan {
  Cost cost = 0;                  // sum of the agents' costs
  std::vector<AgentPlan> agents;  // by AgentIndex
};

// The plan in which each agent stays at its start. It need not be valid. It stands in for a plan
// while there is none.
Plan standing_plan(const Instance& instance);

enum class Status : std::uint8_t {
  kOptimal,     // there is a plan, and its cost is equal to the lower bound
  kBounded,     // there is a plan, w is finite, and cost <= (1 + w) * lower bound
  kFeasible,    // there is a plan, and neither of the above is proven
  kInfeasible,  // it is proven that no plan exists
  kUnknown,     // no plan was found before a limit was reached
};

std::string_view to_string(Status status);
std::optional<Status> parse_status(std::string_view text);

// The status that follows from the cost of a plan and a proven lower bound. `cost`: nullopt if
// there is no plan; the status is then kUnknown.
Status status_of(std::optional<Cost> cost, Cost lower_bound, Omega omega);

// Statistics of a run, by name, as in "stats" of the plan file. A name includes the unit, if there
// is one, as in wall_s.
struct Stats {
  std::map<std::string, std::int64_t> counts;
  std::map<std::string, double> measures;
  std::map<std::string, std::string> texts;
};

struct Solution {
  Status status = Status::kUnknown;
  std::optional<Plan> plan;
  Cost lower_bound = 0;  // proven: no plan costs less; 0 and without meaning if infeasible
  Omega omega;
  bool may_follow = true;  // false: plan and bound refer to the instance without following
  Stats stats;
};

}  // namespace grove::detail
