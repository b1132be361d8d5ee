// SPDX-License-Identifier: MIT
#include "tests/oracle/agent_states.h"

#include <algorithm>

#include "tests/oracle/steps.h"

namespace grove::detail::oracle {
namespace {

constexpr std::size_t kMaxStates = std::size_t{1} << 20;

std::uint64_t bit(std::size_t task) {
  return std::uint64_t{1} << task;
}

}  // namespace

AgentStates::AgentStates(const Instance& instance, AgentIndex agent)
    : instance_(instance),
      agent_(instance.agent(agent)),
      tasks_(agent_.tasks),
      steps_(steps_on(instance.map())) {
  tasks_.insert(tasks_.end(), agent_.options.begin(), agent_.options.end());
  AgentState start{.pose = instance.pose_of(agent_.start)};
  if (instance.world().is_working(agent_.start)) {
    const Work& work = instance.world().work(agent_.start);
    start.work = static_cast<int>(std::ranges::find(tasks_, work.task) - tasks_.begin());
    start.done = work.done;
  }
  arrive(start);
  number(start);
  for (State s = 0; s < count(); ++s) connect(s);
  compute_costs_to_go();
}

AgentStates::State AgentStates::number(const AgentState& standing) {
  const auto [known, is_new] = numbers_.try_emplace(standing, count());
  if (is_new) {
    if (states_.size() == kMaxStates) throw TooMany();
    states_.push_back(standing);
    moves_.emplace_back();
  }
  return known->second;
}

// Marks the tasks on the agent's place that take no time as visited.
void AgentStates::arrive(AgentState& standing) const {
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    const Task& task = instance_.task(tasks_[k]);
    if (task.duration == 0 && task.cell == standing.pose.place) standing.visited |= bit(k);
  }
}

// An agent without a destination that must visit a task rests on the place of a task that it has
// visited. One that must visit none rests anywhere, but within a turn only if no task lists it.
bool AgentStates::may_rest(const AgentState& standing) const {
  const std::uint64_t required = bit(agent_.tasks.size()) - 1;
  if (standing.work >= 0 || (standing.visited & required) != required) return false;
  const Pose& pose = standing.pose;
  if (agent_.goal || !agent_.goals.empty()) {
    const bool is_there =
        agent_.goal ? pose.place == *agent_.goal : std::ranges::count(agent_.goals, pose.place) > 0;
    return is_there &&
           (!agent_.goal_heading || (pose.steps == 0 && pose.heading == *agent_.goal_heading));
  }
  if (agent_.tasks.empty()) return agent_.options.empty() || pose.steps == 0;
  for (std::size_t k = 0; k < tasks_.size(); ++k)
    if ((standing.visited & bit(k)) != 0 && instance_.task(tasks_[k]).cell == pose.place)
      return true;
  return false;
}

// An agent that has started a task continues it until it is completed. In the next step it can
// move.
std::vector<AgentState> AgentStates::next(const AgentState& standing) const {
  std::vector<AgentState> next;
  const auto work_on = [&](int work, Time done) {
    AgentState then = standing;
    const auto k = static_cast<std::size_t>(work);
    then.work = work;
    then.done = done;
    if (done == instance_.task(tasks_[k]).duration) {
      then.work = -1;
      then.done = 0;
      then.visited |= bit(k);
    }
    next.push_back(then);
  };
  if (standing.work >= 0) {
    work_on(standing.work, standing.done + 1);
    return next;
  }
  next.push_back(standing);
  for (const Pose& pose : next_poses(instance_, agent_, steps_, standing.pose)) {
    next.push_back(standing);
    next.back().pose = pose;
    arrive(next.back());
  }
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    const Task& task = instance_.task(tasks_[k]);
    if (task.duration > 0 && task.cell == standing.pose.place && (standing.visited & bit(k)) == 0)
      work_on(static_cast<int>(k), 1);
  }
  return next;
}

void AgentStates::connect(State s) {
  const AgentState here = states_[s];
  if (here.resting) {
    moves_[s].push_back({s, 0});
    return;
  }
  if (may_rest(here)) {
    AgentState resting = here;
    resting.resting = true;
    const State to = number(resting);
    moves_[s].push_back({to, 0});
  }
  for (const AgentState& then : next(here)) {
    const State to = number(then);
    moves_[s].push_back({to, 1});
  }
}

// Value iteration until no cost changes, chosen for simplicity over speed.
void AgentStates::compute_costs_to_go() {
  to_go_.assign(moves_.size(), kNever);
  for (State s = 0; s < count(); ++s)
    if (resting(s) || may_rest(states_[s])) to_go_[s] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (State s = count() - 1; s >= 0; --s) {
      for (const Move& move : moves_[s]) {
        if (to_go_[move.to] == kNever || to_go_[move.to] + move.cost >= to_go_[s]) continue;
        to_go_[s] = to_go_[move.to] + move.cost;
        changed = true;
      }
    }
  }
}

}  // namespace grove::detail::oracle
