// SPDX-License-Identifier: MIT
#include "execution/advance.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/assert.h"

namespace grove::detail {
namespace {

// The finish time, from which the state does not change and no task execution is in progress or to
// come.
Time finish(const AgentPlan& plan) {
  Time last = static_cast<Time>(plan.path.size()) - 1;
  while (last > 0 && plan.path[last - 1] == plan.path.back()) --last;
  for (const WorkTime& work : plan.work) last = std::max(last, work.end);
  return last;
}

// Computes the remainder of one agent after `time` steps.
class AgentLater {
 public:
  AgentLater(const Instance& instance, AgentIndex agent, const AgentPlan& plan, Time time,
             Rests rests, bool ended_with_plan)
      : instance_(instance),
        agent_index_(agent),
        agent_(instance.agent(agent)),
        plan_(plan),
        time_(time),
        rests_(rests),
        has_destination_(agent_.has_destination() && !ended_with_plan) {
    for (const TaskIndex task : agent_.tasks)
      if (!is_visited(task)) left_.push_back(task);
    for (const TaskIndex task : agent_.options)
      (is_visited(task) ? made_ : options_).push_back(task);
  }

  // The tasks that the agent must still visit, and those that it may still visit.
  const std::vector<TaskIndex>& left() const { return left_; }
  const std::vector<TaskIndex>& options() const { return options_; }
  // The optional tasks that it has visited.
  const std::vector<TaskIndex>& made() const { return made_; }
  // Leaves out the optional tasks that need no further visit. `is_kept`: by task.
  void keep_options(const std::vector<bool>& is_kept) {
    std::erase_if(options_, [&](TaskIndex task) { return !is_kept[task]; });
  }

  bool ends_with_plan() const {
    return !has_destination_ && rests_ == Rests::kAnywhere && destination().has_value();
  }

  AgentSpec spec() const {
    AgentSpec spec = instance_.spec(agent_index_);
    spec.start = instance_.pose_of(state_at(plan_.path, time_));
    spec.goal = destination();
    spec.working.reset();
    if (const WorkTime* work = work_under_way(); work && is_left(work->task))
      spec.working = WorkBegun{instance_.task(work->task).id, time_ - work->begin};
    return spec;
  }

  // `later`: by task of `instance`, its index in the remainder.
  AgentPlan plan(const std::vector<TaskIndex>& later) const {
    AgentPlan rest;
    for (const TaskIndex task : plan_.sequence)
      if (is_left(task)) rest.sequence.push_back(later[task]);
    for (const WorkTime& work : plan_.work)
      if (continues(work) && is_left(work.task))
        rest.work.push_back({later[work.task], work.begin - time_, work.end - time_});
    rest.path.assign(plan_.path.begin() + std::min(time_, end()), plan_.path.end());
    rest.cost = finish(rest);
    rest.path.resize(static_cast<std::size_t>(rest.cost) + 1, rest.path.back());
    return rest;
  }

 private:
  Time end() const { return static_cast<Time>(plan_.path.size()) - 1; }

  bool is_left(TaskIndex task) const {
    return std::ranges::count(left_, task) > 0 || std::ranges::count(options_, task) > 0;
  }

  // True if the task execution is not completed at time_.
  bool continues(const WorkTime& work) const { return work.end > time_; }

  const WorkTime* work_under_way() const {
    const bool is_at_work = instance_.world().is_working(agent_.start);
    const auto is_first = [&](const WorkTime& work) { return &work == &plan_.work.front(); };
    for (const WorkTime& work : plan_.work)
      if (continues(work) && (work.begin < time_ || (is_at_work && is_first(work)))) return &work;
    return nullptr;
  }

  bool is_visited(TaskIndex index) const {
    const Task& task = instance_.task(index);
    if (task.has_stated_visits())
      return std::ranges::any_of(
          plan_.work, [&](const WorkTime& w) { return w.task == index && !continues(w); });
    const auto last = plan_.path.begin() + std::min(time_, end()) + 1;
    return std::any_of(plan_.path.begin(), last,
                       [&](State state) { return instance_.world().place(state) == task.cell; });
  }

  Place place_of_rest() const { return instance_.world().place(plan_.path.back()); }

  // The destination in the remainder; see advance().
  std::optional<Place> destination() const {
    const auto rests_on = [&](TaskIndex task) {
      return instance_.task(task).cell == place_of_rest();
    };
    if (has_destination_ || agent_.is_idle()) return agent_.goal;
    const bool is_own = agent_.goal || std::ranges::any_of(agent_.tasks, rests_on) ||
                        std::ranges::any_of(plan_.work, rests_on, &WorkTime::task);
    if (left_.empty()) {
      if (rests_ == Rests::kWhereItMust)
        return is_own ? place_of_rest() : instance_.task(agent_.tasks.front()).cell;
      // An idle agent with optional tasks must not rest within a turn.
      const bool within_turn = instance_.pose_of(plan_.path.back()).steps > 0;
      return within_turn && !options_.empty() ? std::optional(place_of_rest()) : std::nullopt;
    }
    if (!is_own || !visits_all() || std::ranges::any_of(left_, rests_on) || ends_on_option())
      return std::nullopt;
    return place_of_rest();
  }

  // True if the agent rests on the place of an optional task that it visits later.
  bool ends_on_option() const {
    return std::ranges::any_of(plan_.work, [&](const WorkTime& work) {
      return continues(work) && is_left(work.task) &&
             instance_.task(work.task).cell == place_of_rest();
    });
  }

  bool visits_all() const {
    return std::ranges::all_of(
        left_, [&](TaskIndex task) { return std::ranges::count(plan_.sequence, task) > 0; });
  }

  const Instance& instance_;
  const AgentIndex agent_index_;
  const Agent& agent_;
  const AgentPlan& plan_;
  const Time time_;
  const Rests rests_;
  const bool has_destination_;
  std::vector<TaskIndex> left_;
  std::vector<TaskIndex> options_;
  std::vector<TaskIndex> made_;
};

// Returns a copy of `instance` in which agent i has the specification spec(i).
template <class Spec>
Instance with_specs(const Instance& instance, const Spec& spec) {
  InstanceBuilder builder = InstanceBuilder::like(instance);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) builder.add_agent(spec(i));
  for (const Task& task : instance.tasks()) {
    std::vector<std::string> agents;
    for (const AgentIndex agent : task.agents) agents.push_back(instance.agent(agent).id);
    builder.add_task(task.id, task.cell, agents, task.duration, task.need);
  }
  return std::move(builder).build();
}

// By task: how many of the agents with a choice must still visit it.
std::vector<int> remaining_needs(const Instance& instance, const std::vector<AgentLater>& agents) {
  std::vector<int> needs;
  for (const Task& task : instance.tasks()) needs.push_back(task.needs_all() ? 0 : task.need);
  for (const AgentLater& agent : agents)
    for (const TaskIndex task : agent.made()) --needs[task];
  return needs;
}

}  // namespace

Instance without_ends_of_plan(const Instance& instance, const std::vector<bool>& agents) {
  if (std::ranges::count(agents, true) == 0) return instance;
  return with_specs(instance, [&](AgentIndex i) {
    AgentSpec spec = instance.spec(i);
    if (agents[i]) spec.goal.reset();
    return spec;
  });
}

Instance with_ends_of_plan(const Instance& instance, const Plan& plan,
                           const std::vector<bool>& agents) {
  if (std::ranges::count(agents, true) == 0) return instance;
  return with_specs(instance, [&](AgentIndex i) {
    AgentSpec spec = instance.spec(i);
    if (agents[i]) spec.goal = instance.world().place(plan.agents[i].path.back());
    return spec;
  });
}

Remainder advance(const Instance& instance, const Plan& plan, Time time, Rests rests,
                  const std::vector<bool>& before) {
  GROVE_ASSERT(time >= 0, "a plan is never advanced to a time before 0");
  std::vector<AgentLater> agents;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    agents.emplace_back(instance, i, plan.agents[i], time, rests, !before.empty() && before[i]);
  const std::vector<int> needs = remaining_needs(instance, agents);
  std::vector<bool> is_kept;
  for (const int need : needs) is_kept.push_back(need > 0);
  InstanceBuilder builder = InstanceBuilder::like(instance);
  std::vector<std::vector<std::string>> visitors(instance.tasks().size());
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    AgentLater& agent = agents[i];
    agent.keep_options(is_kept);
    builder.add_agent(agent.spec());
    for (const TaskIndex task : agent.left()) visitors[task].push_back(instance.agent(i).id);
    for (const TaskIndex task : agent.options()) visitors[task].push_back(instance.agent(i).id);
  }
  std::vector<TaskIndex> later(instance.tasks().size(), -1);
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const Task& task = instance.task(i);
    const auto need = task.needs_all() ? std::nullopt : std::optional(needs[i]);
    if (!visitors[i].empty())
      later[i] = builder.add_task(task.id, task.cell, visitors[i], task.duration, need);
  }
  Remainder rest{std::move(builder).build(), {}, {}};
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    rest.ends_with_plan.push_back(agents[i].ends_with_plan());
    AgentPlan& own = rest.plan.agents.emplace_back(agents[i].plan(later));
    end_on_the_place_of_rest(rest.instance, i, own);
    GROVE_CHECK(own.path.front() == rest.instance.world().base(rest.instance.agent(i).start),
                "the rest of a plan begins at the starts of its instance");
    GROVE_ASSERT(std::ranges::none_of(own.sequence, [](TaskIndex task) { return task < 0; }),
                 "the rest of a sequence holds tasks of the new instance");
    rest.plan.cost += own.cost;
  }
  return rest;
}

namespace {

// Returns the first `time` steps of an agent's plan, with the task executions that are completed by
// then.
AgentPlan first_steps(const AgentPlan& plan, Time time) {
  AgentPlan first;
  for (const WorkTime& work : plan.work)
    if (work.end <= time) first.work.push_back(work);
  const Time end = std::min(time, static_cast<Time>(plan.path.size()) - 1);
  first.path.assign(plan.path.begin(), plan.path.begin() + end + 1);
  return first;
}

AgentPlan joined(const Instance& instance, AgentIndex agent, AgentPlan first, Time time,
                 const AgentPlan& rest, const std::vector<TaskIndex>& before) {
  std::vector<TaskIndex> later;
  for (const TaskIndex task : rest.sequence) later.push_back(before[task]);
  for (const TaskIndex task : instance.agent(agent).tasks)
    if (std::ranges::count(later, task) == 0) first.sequence.push_back(task);
  std::ranges::stable_sort(first.sequence, {},
                           [&](TaskIndex task) { return visit_time(instance, first, task); });
  first.sequence.insert(first.sequence.end(), later.begin(), later.end());
  if (rest.cost > 0) {
    first.path.resize(static_cast<std::size_t>(time) + 1, first.path.back());
    first.path.insert(first.path.end(), rest.path.begin() + 1, rest.path.end());
    for (const WorkTime& work : rest.work)
      first.work.push_back({before[work.task], work.begin + time, work.end + time});
  }
  first.cost = rest.cost > 0 ? time + rest.cost : finish(first);
  first.path.resize(static_cast<std::size_t>(first.cost) + 1, first.path.back());
  end_on_the_place_of_rest(instance, agent, first);
  GROVE_ASSERT(std::ranges::is_permutation(first.sequence, instance.agent(agent).tasks),
               "a joined plan visits each task of its agent once");
  return first;
}

}  // namespace

Time finish_of_steps(const AgentPlan& plan, Time time) {
  return finish(first_steps(plan, time));
}

Plan joined(const Instance& instance, const Plan& plan, Time time, const Instance& later,
            const Plan& rest) {
  std::unordered_map<std::string, TaskIndex> by_id;
  for (TaskIndex task = 0; task < instance.task_count(); ++task)
    by_id.emplace(instance.task(task).id, task);
  std::vector<TaskIndex> before;
  for (const Task& task : later.tasks()) before.push_back(by_id.at(task.id));
  Plan whole;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    whole.agents.push_back(joined(instance, agent, first_steps(plan.agents[agent], time), time,
                                  rest.agents[agent], before));
    whole.cost += whole.agents.back().cost;
  }
  return whole;
}

}  // namespace grove::detail
