// SPDX-License-Identifier: MIT
#include "model/plan.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::array<std::pair<Status, std::string_view>, 5> kNames{{
    {Status::kOptimal, "optimal"},
    {Status::kBounded, "bounded"},
    {Status::kFeasible, "feasible"},
    {Status::kInfeasible, "infeasible"},
    {Status::kUnknown, "unknown"},
}};

}  // namespace

Time last_arrival(const World& world, const Path& path) {
  Time time = static_cast<Time>(path.size()) - 1;
  while (time > 0 && world.place(path[time - 1]) == world.place(path.back())) --time;
  return time;
}

namespace {

// The task execution whose first step ends at `time`. For time 0, the execution in progress at the
// start; its begin is minus the number of steps done. Returns nullopt if there is none.
// Precondition: the path contains no wait within a task execution.
std::optional<WorkTime> work_begun(const Instance& instance, const Path& path, Time time) {
  const World& world = instance.world();
  if (!world.is_working(path[time])) return std::nullopt;
  const Work& work = world.work(path[time]);
  if (time > 0 && world.is_working(path[time - 1]) && world.work(path[time - 1]).task == work.task)
    return std::nullopt;
  const Time begin = time == 0 ? -work.done : time - 1;
  return WorkTime{work.task, begin, begin + instance.task(work.task).duration};
}

// The plan of the path without a sequence: its base states and task executions. The agent finishes
// at its last arrival, or at the end of its last task execution.
AgentPlan plan_without_sequence(const Instance& instance, const Path& path) {
  const World& world = instance.world();
  AgentPlan plan;
  plan.path.reserve(path.size());
  plan.cost = last_arrival(world, path);
  for (Time t = 0; t < static_cast<Time>(path.size()); ++t) {
    plan.path.push_back(world.base(path[t]));
    if (const auto work = work_begun(instance, path, t)) {
      plan.work.push_back(*work);
      plan.cost = std::max(plan.cost, work->end);
    }
  }
  return plan;
}

void end_at_cost(AgentPlan& plan) {
  plan.path.resize(static_cast<std::size_t>(plan.cost) + 1, plan.path.back());
}

// The earliest time from `begin` on at which the path visits the task; for a task that takes time,
// the end of its execution.
Time visit_from(const Instance& instance, const AgentPlan& plan, TaskIndex task, Time begin) {
  if (instance.task(task).duration > 0) return visit_time(instance, plan, task);
  const auto is_there = [&](State state) {
    return instance.world().place(state) == instance.task(task).cell;
  };
  const auto visit = std::find_if(plan.path.begin() + begin, plan.path.end(), is_there);
  GROVE_CHECK(visit != plan.path.end(), "a path visits its tasks in their order");
  return static_cast<Time>(visit - plan.path.begin());
}

}  // namespace

AgentPlan agent_plan(const Instance& instance, AgentIndex agent,
                     std::span<const std::uint8_t> stops, const Path& path) {
  AgentPlan plan = plan_without_sequence(instance, path);
  plan.sequence = instance.tasks_in_order(agent, stops);
  const auto end = static_cast<Time>(path.size()) - 1;
  while (plan.cost < end && !instance.may_rest(agent, plan.path[plan.cost])) ++plan.cost;
  end_at_cost(plan);
  GROVE_ASSERT(instance.may_rest(agent, plan.path.back()),
               "an agent's plan ends where it may rest");
  GROVE_ASSERT(std::ranges::is_permutation(plan.sequence, instance.agent(agent).tasks),
               "an agent's sequence holds each of its tasks once");
  GROVE_ASSERT(std::ranges::is_sorted(plan.work, {}, &WorkTime::begin),
               "task executions are in order of time");
  return plan;
}

// Tasks that the agent must visit and that are not stops come immediately before its first visit on
// their place.
AgentPlan agent_plan_of_visits(const Instance& instance, AgentIndex agent,
                               std::span<const TaskIndex> visits, const Path& path) {
  AgentPlan plan = plan_without_sequence(instance, path);
  const bool has_destination = instance.agent(agent).has_destination();
  const auto end = static_cast<Time>(path.size()) - 1;
  while (has_destination && plan.cost < end && !instance.may_rest(agent, plan.path[plan.cost]))
    ++plan.cost;
  end_at_cost(plan);
  std::vector<WorkTime> stated;
  Time now = 0;
  for (const TaskIndex task : visits) {
    const Task& of = instance.task(task);
    for (const TaskIndex other : instance.agent(agent).tasks)
      if (instance.task(other).cell == of.cell && std::ranges::count(visits, other) == 0 &&
          std::ranges::count(plan.sequence, other) == 0)
        plan.sequence.push_back(other);
    plan.sequence.push_back(task);
    now = visit_from(instance, plan, task, std::max(now, 0));
    if (of.duration == 0 && of.has_stated_visits()) stated.push_back({task, now, now});
  }
  plan.work.insert(plan.work.end(), stated.begin(), stated.end());
  std::ranges::stable_sort(plan.work, {}, &WorkTime::begin);
  return plan;
}

AgentPlan plan_of_path(const Instance& instance, AgentIndex agent, const Path& path) {
  const std::vector<TaskIndex>& stops = instance.agent(agent).stops;
  std::vector<std::uint8_t> order(stops.size());
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  const bool ends_on_a_stop = instance.rests_on_last_stop(agent);
  std::ranges::stable_sort(order, {}, [&](std::uint8_t stop) {
    const auto visits = [&](State state) { return instance.is_visited(stops[stop], state); };
    const bool last = ends_on_a_stop && visits(path.back());
    return (last ? path.end() : std::ranges::find_if(path, visits)) - path.begin();
  });
  return agent_plan(instance, agent, order, path);
}

// Moves each task execution within a turn back to the last earlier pose that is not within a turn
// or is the agent's start. This is necessary because the start is the only pose within a turn in
// which the world has states at work.
AgentPlan with_work_before_turns(const Instance& instance, AgentPlan plan) {
  for (WorkTime& work : plan.work) {
    if (work.begin <= 0) continue;
    const auto within_turn = [&](Time t) {
      return instance.pose_of(plan.path[t]).steps > 0 && plan.path[t] != plan.path.front();
    };
    Time turn = work.begin;
    while (turn > 0 && within_turn(turn)) --turn;
    const auto at = [&](Time t) { return plan.path.begin() + t; };
    std::rotate(at(turn) + 1, at(work.begin) + 1, at(work.end) + 1);
    std::fill_n(at(turn) + 1, work.end - work.begin, plan.path[turn]);
    GROVE_ASSERT(turn >= 0 && turn <= work.begin,
                 "a task execution is never moved to a later time");
    work.end -= work.begin - turn;
    work.begin = turn;
  }
  return plan;
}

namespace {

bool follows_moves(const World& world, const Path& path) {
  return std::ranges::adjacent_find(path, [&](State from, State to) {
           return from != to && std::ranges::count(world.moves(from), to) == 0;
         }) == path.end();
}

}  // namespace

Path walked_path(const Instance& instance, AgentIndex agent, const AgentPlan& given) {
  const AgentPlan plan = with_work_before_turns(instance, given);
  Path path(plan.path.begin(), plan.path.begin() + plan.cost + 1);
  path[0] = instance.agent(agent).start;
  for (const WorkTime& work : plan.work) {
    if (work.begin == work.end) continue;  // a stated visit to a task without a duration
    const State base = plan.path[std::max(work.begin, 0)];
    const auto at_work = [&](Time done) {
      return instance.motion_world()->working(work.task, base, done);
    };
    for (Time t = std::max(work.begin + 1, 0); t <= work.end; ++t)
      path[t] = at_work(t - work.begin);
    for (Time t = work.end + 1; t <= plan.cost && plan.path[t] == base; ++t)
      path[t] = path[work.end];
  }
  GROVE_ASSERT(follows_moves(instance.world(), path), "a walked path consists of moves and waits");
  return path;
}

Time visit_time(const Instance& instance, const AgentPlan& plan, TaskIndex task) {
  const auto work = std::ranges::find(plan.work, task, &WorkTime::task);
  if (work != plan.work.end()) return work->end;
  const auto visit = std::ranges::find_if(plan.path, [&](State state) {
    return instance.world().place(state) == instance.task(task).cell;
  });
  return static_cast<Time>(visit - plan.path.begin());
}

void end_on_the_place_of_rest(const Instance& instance, AgentIndex agent, AgentPlan& plan) {
  const auto is_stated = [&](TaskIndex task) { return instance.task(task).has_stated_visits(); };
  if (!instance.rests_on_last_stop(agent) || std::ranges::any_of(plan.sequence, is_stated)) return;
  const Place rest = instance.world().place(plan.path.back());
  std::stable_partition(plan.sequence.begin(), plan.sequence.end(),
                        [&](TaskIndex task) { return instance.task(task).cell != rest; });
}

Plan standing_plan(const Instance& instance) {
  Plan plan;
  for (const Agent& agent : instance.agents())
    plan.agents.push_back({.sequence = {}, .path = {instance.world().base(agent.start)}});
  return plan;
}

std::string_view to_string(Status status) {
  for (const auto& [value, name] : kNames)
    if (value == status) return name;
  return "";
}

std::optional<Status> parse_status(std::string_view text) {
  for (const auto& [value, name] : kNames)
    if (name == text) return value;
  return std::nullopt;
}

Status status_of(std::optional<Cost> cost, Cost lower_bound, Omega omega) {
  if (!cost) return Status::kUnknown;
  if (*cost <= lower_bound) return Status::kOptimal;
  // With w = inf the caller requested no tolerance, so kBounded would be meaningless.
  if (!omega.is_infinite() && omega.accepts(*cost, lower_bound)) return Status::kBounded;
  return Status::kFeasible;
}

}  // namespace grove::detail
