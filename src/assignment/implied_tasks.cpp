// SPDX-License-Identifier: MIT
// *Implied tasks.* Let t and u be tasks on one place, t without a duration, and with more agents
// than it needs. Let A_t, A_u be their agents and n_t, n_u their needs. At least n_u - |A_u \ A_t|
// agents of A_t visit u in every plan. If this is at least n_t, then t is *implied* by u, provided
// that each agent of A_t may rest without t wherever it may rest with t. *Claim: the least cost is
// the same without t.* *Proof.* Visits to t can be added to a plan without t: an agent that visits
// u is on the place of t at some step, and a visit to t takes no time. They do not change the cost,
// because the agent visits u no earlier than it first is on the place. Conversely, a plan remains
// valid without its visits to t, and does not cost more: no agent is obliged to visit t, so only
// the rule of rest has to be checked.
//
// *Rest.* Nothing changes for an agent with a destination. An agent that is obliged to nothing
// rests anywhere, but not within a turn if a task lists it. An agent that is obliged to something
// rests on a task that it has visited; if u takes no time and lists the agent, it visits u whenever
// it visits t. So an agent of A_t needs a destination, or is in A_u while u takes no time, or is
// obliged to nothing and either turns freely or is in A_u.
//
// Tasks are left out one by one. Each step is a transformation of the instance before, so u may
// itself be left out later.
#include "assignment/implied_tasks.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "assignment/assignment.h"

namespace grove::detail {
namespace {

bool lists(const Task& task, AgentIndex agent) {
  return std::ranges::binary_search(task.agents, agent);
}

bool may_rest_without(const Instance& instance, AgentIndex index, const Task& by) {
  const Agent& agent = instance.agent(index);
  if (agent.has_destination()) return true;
  if (agent.is_idle()) return agent.kind == 0 || lists(by, index);
  return by.duration == 0 && lists(by, index);
}

bool is_implied(const Instance& instance, const Task& task, const Task& by) {
  if (task.duration > 0 || task.needs_all()) return false;
  const auto others =
      std::ranges::count_if(by.agents, [&](AgentIndex agent) { return !lists(task, agent); });
  return by.need - others >= task.need && std::ranges::all_of(task.agents, [&](AgentIndex agent) {
           return may_rest_without(instance, agent, by);
         });
}

Instance without_tasks(const Instance& whole, const std::vector<TaskIndex>& kept) {
  InstanceBuilder builder = InstanceBuilder::like(whole);
  for (AgentIndex i = 0; i < whole.agent_count(); ++i) builder.add_agent(whole.spec(i));
  for (const TaskIndex index : kept) {
    const Task& task = whole.task(index);
    std::vector<std::string> ids;
    for (const AgentIndex agent : task.agents) ids.push_back(whole.agent(agent).id);
    builder.add_task(task.id, task.cell, ids, task.duration, task.need);
  }
  return std::move(builder).build();
}

}  // namespace

std::vector<WithoutImpliedTasks::Implied> WithoutImpliedTasks::find(const Instance& whole) {
  std::unordered_map<Place, std::vector<TaskIndex>> tasks_on;  // those not left out
  for (TaskIndex i = 0; i < whole.task_count(); ++i) tasks_on[whole.task(i).cell].push_back(i);
  std::vector<Implied> implied;
  for (TaskIndex i = 0; i < whole.task_count(); ++i) {
    std::vector<TaskIndex>& here = tasks_on[whole.task(i).cell];
    const auto by = std::ranges::find_if(here, [&](TaskIndex other) {
      return other != i && is_implied(whole, whole.task(i), whole.task(other));
    });
    if (by == here.end()) continue;
    implied.push_back({i, *by});
    std::erase(here, i);
  }
  return implied;
}

std::optional<WithoutImpliedTasks> WithoutImpliedTasks::make(const Instance& whole) {
  std::vector<Implied> implied = find(whole);
  if (implied.empty()) return std::nullopt;
  std::vector<TaskIndex> kept;
  for (TaskIndex task = 0; task < whole.task_count(); ++task)
    if (std::ranges::count(implied, task, &Implied::task) == 0) kept.push_back(task);
  return WithoutImpliedTasks(whole, std::move(implied), std::move(kept));
}

WithoutImpliedTasks::WithoutImpliedTasks(const Instance& whole, std::vector<Implied> implied,
                                         std::vector<TaskIndex> kept)
    : whole_(&whole),
      implied_(std::move(implied)),
      kept_(std::move(kept)),
      instance_(without_tasks(whole, kept_)) {}

Plan WithoutImpliedTasks::to_whole(Plan plan) const {
  for (AgentPlan& agent : plan.agents) {
    for (TaskIndex& task : agent.sequence) task = kept_[task];
    for (WorkTime& work : agent.work) work.task = kept_[work.task];
  }
  for (auto i = implied_.rbegin(); i != implied_.rend(); ++i) add_visits(*i, plan);
  return with_stated_visits(*whole_, std::move(plan));
}

// Adds as many visits as the task needs.
void WithoutImpliedTasks::add_visits(const Implied& implied, Plan& plan) const {
  const Task& task = whole_->task(implied.task);
  int missing = task.need;
  for (const AgentIndex agent : task.agents) {
    std::vector<TaskIndex>& sequence = plan.agents[agent].sequence;
    if (missing == 0) return;
    if (std::ranges::count(sequence, implied.by) == 0) continue;
    sequence.push_back(implied.task);
    --missing;
  }
}

}  // namespace grove::detail
