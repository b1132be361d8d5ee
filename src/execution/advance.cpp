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

// The time at which the plan visits a task. Precondition: the plan visits it.
Time visit_time(const Instance& instance, const AgentPlan& plan, TaskIndex index) {
  const Task& task = instance.task(index);
  if (task.duration > 0) return std::ranges::find(plan.work, index, &WorkTime::task)->end;
  const auto is_there = [&](State s) { return instance.world().place(s) == task.cell; };
  return static_cast<Time>(std::ranges::find_if(plan.path, is_there) - plan.path.begin());
}

// If the agent rests on the last stop of its sequence, moves the tasks on its last place to the end
// of the sequence. They may be earlier in the sequence if the path visits that place several times.
void end_on_the_place_of_rest(const Instance& instance, AgentIndex agent, AgentPlan& plan) {
  if (!instance.rests_on_last_stop(agent)) return;
  const Place rest = instance.world().place(plan.path.back());
  std::stable_partition(plan.sequence.begin(), plan.sequence.end(),
                        [&](TaskIndex task) { return instance.task(task).cell != rest; });
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
        has_goal_(agent_.goal && !ended_with_plan) {
    for (const TaskIndex task : agent_.tasks)
      if (!is_visited(task)) left_.push_back(task);
  }

  const std::vector<TaskIndex>& left() const { return left_; }
  bool ends_with_plan() const {
    return !has_goal_ && rests_ == Rests::kAnywhere && destination().has_value();
  }

  AgentSpec spec() const {
    AgentSpec spec = instance_.spec(agent_index_);
    spec.start = instance_.pose_of(state_at(plan_.path, time_));
    spec.goal = destination();
    spec.working.reset();
    if (const WorkTime* work = work_under_way())
      spec.working = WorkBegun{instance_.task(work->task).id, time_ - work->begin};
    return spec;
  }

  // `later`: by task of `instance`, its index in the remainder.
  AgentPlan plan(const std::vector<TaskIndex>& later) const {
    AgentPlan rest;
    for (const TaskIndex task : plan_.sequence)
      if (std::ranges::count(left_, task) > 0) rest.sequence.push_back(later[task]);
    for (const WorkTime& work : plan_.work)
      if (continues(work))
        rest.work.push_back({later[work.task], work.begin - time_, work.end - time_});
    rest.path.assign(plan_.path.begin() + std::min(time_, end()), plan_.path.end());
    rest.cost = finish(rest);
    rest.path.resize(static_cast<std::size_t>(rest.cost) + 1);
    return rest;
  }

 private:
  Time end() const { return static_cast<Time>(plan_.path.size()) - 1; }

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
    if (task.duration > 0)
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
    if (has_goal_ || agent_.is_idle()) return agent_.goal;
    const bool is_own = agent_.goal || std::ranges::any_of(agent_.tasks, rests_on);
    if (left_.empty()) {
      if (rests_ == Rests::kAnywhere) return std::nullopt;
      return is_own ? place_of_rest() : instance_.task(agent_.tasks.front()).cell;
    }
    if (!is_own || !visits_all() || std::ranges::any_of(left_, rests_on)) return std::nullopt;
    return place_of_rest();
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
  const bool has_goal_;
  std::vector<TaskIndex> left_;
};

// Returns a copy of `instance` in which agent i has the specification spec(i).
template <class Spec>
Instance with_specs(const Instance& instance, const Spec& spec) {
  InstanceBuilder builder = InstanceBuilder::like(instance);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) builder.add_agent(spec(i));
  for (const Task& task : instance.tasks()) {
    std::vector<std::string> agents;
    for (const AgentIndex agent : task.agents) agents.push_back(instance.agent(agent).id);
    builder.add_task(task.id, task.cell, agents, task.duration);
  }
  return std::move(builder).build();
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
  GROVE_CHECK(!instance.has_choices(), "remainders do not support choices");
  std::vector<AgentLater> agents;
  InstanceBuilder builder = InstanceBuilder::like(instance);
  std::vector<std::vector<std::string>> visitors(instance.tasks().size());
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    agents.emplace_back(instance, i, plan.agents[i], time, rests, !before.empty() && before[i]);
    builder.add_agent(agents.back().spec());
    for (const TaskIndex task : agents.back().left())
      visitors[task].push_back(instance.agent(i).id);
  }
  std::vector<TaskIndex> later(instance.tasks().size(), -1);
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const Task& task = instance.task(i);
    if (!visitors[i].empty())
      later[i] = builder.add_task(task.id, task.cell, visitors[i], task.duration);
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
