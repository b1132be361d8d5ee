// SPDX-License-Identifier: MIT
#include "assignment/assignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include "execution/advance.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

bool has_task(const Instance& instance, const Assignment& assignment, AgentIndex agent,
              TaskIndex task) {
  return instance.task(task).needs_all() ||
         std::ranges::binary_search(assignment[agent].visits, task);
}

// If the agent visits a task with a choice of agents, its sequence is then in the order of first
// visits. (An agent with stated visits need not end on the last task of its sequence.)
void state_visits(const Instance& instance, AgentPlan& plan) {
  std::vector<WorkTime> stated;
  for (const TaskIndex task : plan.sequence)
    if (instance.task(task).has_stated_visits() &&
        std::ranges::count(plan.work, task, &WorkTime::task) == 0) {
      const Time time = visit_time(instance, plan, task);
      stated.push_back({task, time, time});
    }
  if (stated.empty()) return;
  plan.work.insert(plan.work.end(), stated.begin(), stated.end());
  std::ranges::stable_sort(plan.work, {}, &WorkTime::begin);
  std::ranges::stable_sort(plan.sequence, {},
                           [&](TaskIndex task) { return visit_time(instance, plan, task); });
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

// True if the agent may end its plan on its last place in `fixed`.
bool ends_where_it_may(const Instance& fixed, AgentIndex agent, const AgentPlan& plan) {
  return fixed.agent(agent).is_idle() || fixed.may_rest(agent, plan.path.back());
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

Assignment assignment_of(const Instance& instance, const Plan& plan) {
  Assignment assignment(instance.agents().size());
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    for (const WorkTime& work : plan.agents[i].work)
      if (std::ranges::binary_search(agent.options, work.task))
        assignment[i].visits.push_back(work.task);
    std::ranges::sort(assignment[i].visits);
    const Place rest = instance.world().place(plan.agents[i].path.back());
    if (std::ranges::count(agent.goals, rest) > 0) assignment[i].goal = rest;
  }
  return assignment;
}

FixedChoices fix_choices(const Instance& instance, const Plan& plan) {
  const Instance fixed = with_assignment(instance, assignment_of(instance, plan));
  std::vector<bool> ends_elsewhere;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    ends_elsewhere.push_back(!ends_where_it_may(fixed, i, plan.agents[i]));
  Instance result = with_ends_of_plan(fixed, plan, ends_elsewhere);
  Plan same = without_other_visits(result, plan);
  return {std::move(result), std::move(same)};
}

std::optional<std::string> destination_within_a_road(const Instance& fixed) {
  const Roadmap* roadmap = fixed.roadmap();
  for (const Agent& agent : fixed.agents())
    if (roadmap && agent.goal && roadmap->spot(*agent.goal).vertex < 0)
      return fmt::format(
          "agent '{}' visits a task by choice and then rests within a road; expected that it rests "
          "on a vertex",
          agent.id);
  return std::nullopt;
}

bool forbids_rest_within_turns(const Instance& instance) {
  return std::ranges::any_of(instance.agents(), [](const Agent& agent) {
    return agent.motion.turn_steps > 1 && agent.is_idle() && !agent.options.empty();
  });
}

Plan without_other_visits(const Instance& fixed, const Plan& plan) {
  Plan result;
  for (AgentIndex i = 0; i < fixed.agent_count(); ++i) {
    AgentPlan& agent = result.agents.emplace_back(plan.agents[i]);
    const auto is_other = [&](TaskIndex task) {
      return !std::ranges::binary_search(fixed.agent(i).tasks, task);
    };
    std::erase_if(agent.sequence, is_other);
    std::erase_if(agent.work, [&](const WorkTime& work) {
      return is_other(work.task) || fixed.task(work.task).duration == 0;
    });
    agent.cost = finish_of_steps(agent, kNever);
    agent.path.resize(static_cast<std::size_t>(agent.cost) + 1, agent.path.back());
    end_on_the_place_of_rest(fixed, i, agent);
    result.cost += agent.cost;
  }
  return result;
}

bool serves(const Instance& fixed, AgentIndex agent, const AgentPlan& plan) {
  return std::ranges::is_permutation(plan.sequence, fixed.agent(agent).tasks) &&
         ends_where_it_may(fixed, agent, plan);
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
