// SPDX-License-Identifier: MIT
#include "assignment/assignment.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

bool has_task(const Instance& instance, const Assignment& assignment, AgentIndex agent,
              TaskIndex task) {
  return instance.task(task).needs_all() ||
         std::ranges::binary_search(assignment[agent].visits, task);
}

// The time of the visit to `task` that the agent's sequence counts: the first one at `begin` or
// later. Precondition: the agent visits the task at this time or later.
Time time_of_visit(const Instance& instance, const AgentPlan& plan, TaskIndex task, Time begin) {
  const auto work = std::ranges::find(plan.work, task, &WorkTime::task);
  if (work != plan.work.end()) return work->end;
  Time time = begin;
  while (place_at(instance.world(), plan.path, time) != instance.task(task).cell) ++time;
  return time;
}

void state_visits(const Instance& instance, AgentPlan& plan) {
  Time now = 0;
  std::vector<WorkTime> stated;
  for (const TaskIndex task : plan.sequence) {
    now = time_of_visit(instance, plan, task, now);
    if (instance.task(task).duration == 0 && instance.task(task).has_stated_visits())
      stated.push_back({task, now, now});
  }
  plan.work.insert(plan.work.end(), stated.begin(), stated.end());
  std::ranges::stable_sort(plan.work, {}, &WorkTime::begin);
  GROVE_ASSERT(plan.work.empty() || plan.work.back().end <= plan.cost,
               "an agent finishes after its last visit");
}

// In with_assignment(), an agent that no task lists any more may rest within a turn. Completing the
// turn does not change its place.
void complete_turn(const Instance& instance, AgentIndex index, AgentPlan& plan) {
  const Agent& agent = instance.agent(index);
  if (!agent.is_idle() || agent.options.empty()) return;
  for (Pose pose = instance.pose_of(plan.path.back()); pose.steps > 0;) {
    ++pose.steps;
    if (pose.steps == agent.motion.turn_steps)
      pose = {.place = pose.place, .heading = pose.to, .to = pose.to};
    plan.path.push_back(instance.state_of(index, pose));
    ++plan.cost;
  }
}

}  // namespace

bool is_complete(const Instance& instance, const Assignment& assignment) {
  std::vector<int> visitors(instance.tasks().size());
  std::set<Place> destinations;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    const AgentChoice& choice = assignment[i];
    for (const TaskIndex task : choice.visits) {
      if (!std::ranges::binary_search(agent.options, task)) return false;
      ++visitors[task];
    }
    if (agent.goals.empty() == choice.goal.has_value()) return false;
    if (choice.goal && std::ranges::count(agent.goals, *choice.goal) == 0) return false;
    const std::optional<Place> destination = choice.goal ? choice.goal : agent.goal;
    if (destination && !destinations.insert(*destination).second) return false;
  }
  for (TaskIndex i = 0; i < instance.task_count(); ++i)
    if (const Task& task = instance.task(i); !task.needs_all() && visitors[i] < task.need)
      return false;
  return true;
}

Instance with_assignment(const Instance& instance, const Assignment& assignment) {
  GROVE_CHECK(is_complete(instance, assignment), "an assignment fixes all choices");
  InstanceBuilder builder = InstanceBuilder::like(instance);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    AgentSpec spec = instance.spec(i);
    if (assignment[i].goal) spec.goal = assignment[i].goal;
    spec.goals.clear();
    builder.add_agent(std::move(spec));
  }
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const Task& task = instance.task(i);
    std::vector<std::string> ids;
    for (const AgentIndex agent : task.agents)
      if (has_task(instance, assignment, agent, i)) ids.push_back(instance.agent(agent).id);
    builder.add_task(task.id, task.cell, ids, task.duration);
  }
  return std::move(builder).build();
}

Plan with_stated_visits(const Instance& instance, Plan plan) {
  plan.cost = 0;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    AgentPlan& agent = plan.agents[i];
    state_visits(instance, agent);
    complete_turn(instance, i, agent);
    plan.cost += agent.cost;
  }
  return plan;
}

}  // namespace grove::detail
