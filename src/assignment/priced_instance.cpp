// SPDX-License-Identifier: MIT
// *Prices.* Let m_t >= 0 be the multiplier of a task t with a choice, n_t its need, and C_t the
// agents that may visit it in a plan below the cutoff. An agent of C_t that does not count t pays
// m_t. Every plan below the cutoff can be written with exactly n_t counted visits to t: the other
// visits are then not stated. So the agents together pay m_t (|C_t| - n_t) in each such plan. If
// |C_t| = n_t, all of C_t must visit t. If m_t = 0, surplus visits change nothing. Let m_g >= 0 be
// the multiplier of a goal g. An agent that chooses g pays m_g. If none does, the plan adds m_g.
// (An agent without a destination can rest on g and does not pay.) *Claim: the cost of the plan is
// the sum of the prices of its paths, plus m_g for the goals for which no agent pays, minus the sum
// of all m_t (|C_t| - n_t) and m_g.* *Proof.* Add the payments.
//
// If fewer than n_t agents are left in C_t, or an agent with a choice of goals has none left, there
// is no plan below the cutoff.
//
// An agent without a destination that must visit a task rests on a task that it has visited. If it
// rests on an optional task that it does not count, this visit is stated as well; it is a surplus
// visit, and the agent has paid the price of leaving it out.
#include "assignment/priced_instance.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "assignment/goal_choice.h"
#include "assignment/routes.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr Time kMaxPrice = 1 << 20;

class Reformulation {
 public:
  Reformulation(const Instance& instance, std::vector<RouteBound::Choices> choices,
                RouteBound::Multipliers multipliers)
      : instance_(instance), choices_(std::move(choices)), multipliers_(std::move(multipliers)) {}

  Pricing make(std::optional<PricedInstance>& priced) {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      if (!has_room(agent)) return Pricing::kNotPossible;
    remove_goals_of_others();
    InstanceBuilder builder = InstanceBuilder::like(instance_);
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      AgentSpec spec = instance_.spec(agent);
      if (!spec.goals.empty()) spec.goals = choices_[agent].goals;
      if (instance_.agent(agent).goals.size() > 0 && spec.goals.empty()) return Pricing::kNoPlan;
      builder.add_agent(std::move(spec));
    }
    for (TaskIndex task = 0; task < instance_.task_count(); ++task) {
      const Task& of = instance_.task(task);
      std::vector<std::string> ids;
      for (const AgentIndex agent : of.agents)
        if (of.needs_all() || may_visit(agent, task)) ids.push_back(instance_.agent(agent).id);
      if (static_cast<int>(ids.size()) < of.need) return Pricing::kNoPlan;
      builder.add_task(of.id, of.cell, ids, of.duration);
    }
    priced.emplace(PricedInstance{std::move(builder).build(), {}});
    add_prices(*priced);
    return Pricing::kDone;
  }

 private:
  bool may_visit(AgentIndex agent, TaskIndex task) const {
    return std::ranges::binary_search(choices_[agent].visits, task);
  }

  bool has_room(AgentIndex index) const {
    const Agent& agent = instance_.agent(index);
    const std::vector<TaskIndex>& visits = choices_[index].visits;
    if (!agent.has_choice()) return true;
    if (agent.tasks.size() + visits.size() > kMaxTasksPerAgent) return false;
    std::set<Place> places;
    bool takes_time = false;
    for (const TaskIndex task : agent.tasks) {
      places.insert(instance_.task(task).cell);
      takes_time |= instance_.task(task).duration > 0;
    }
    for (const TaskIndex task : visits) {
      if (!places.insert(instance_.task(task).cell).second) return false;
      takes_time |= instance_.task(task).duration > 0;
    }
    return agent.has_destination() || agent.tasks.empty() || visits.empty() || !takes_time;
  }

  // No agent can end on the destination of an agent without a choice.
  void remove_goals_of_others() {
    const std::vector<Place> taken = all_destinations(
        instance_, [](const Agent& agent) { return agent.goals.empty() && agent.goal; });
    for (RouteBound::Choices& choices : choices_)
      std::erase_if(choices.goals,
                    [&](Place goal) { return std::ranges::binary_search(taken, goal); });
  }

  void add_prices(PricedInstance& priced) const {
    Prices& prices = priced.prices;
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      prices.agents.push_back(prices_of(priced.instance, agent));
    for (TaskIndex task = 0; task < instance_.task_count(); ++task) {
      const Task& of = priced.instance.task(task);
      const int need = instance_.task(task).need;
      const auto surplus = static_cast<Cost>(of.agents.size()) - need;
      if (surplus == 0) continue;
      const Time multiplier = price_of(task);
      Prices::Need& made = prices.needs.emplace_back();
      made.count = need;
      made.is_exact = multiplier > 0;
      for (const AgentIndex agent : of.agents) {
        const std::vector<TaskIndex>& stops = priced.instance.agent(agent).stops;
        made.visits.push_back(
            {agent, static_cast<int>(std::ranges::find(stops, task) - stops.begin())});
      }
      prices.constant += multiplier * surplus;
    }
    for (const auto& [place, price] : multipliers_.on_goals)
      if (price > 0 && is_choice(place)) {
        prices.goals.push_back({place, price});
        prices.constant += price;
      }
  }

  // At most kMaxPrice, so that sums are far below kNever. Any multiplier is valid.
  Time price_of(TaskIndex task) const { return std::min(multipliers_.on_visits[task], kMaxPrice); }

  bool is_choice(Place goal) const {
    return std::ranges::any_of(choices_, [&](const RouteBound::Choices& choices) {
      return std::ranges::count(choices.goals, goal) > 0;
    });
  }

  std::optional<AgentPrices> prices_of(const Instance& priced, AgentIndex index) const {
    const Agent& agent = instance_.agent(index);
    if (!agent.has_choice()) return std::nullopt;
    AgentPrices prices;
    prices.rests_anywhere = agent.is_idle();
    for (const TaskIndex task : priced.agent(index).stops) {
      const bool is_optional =
          static_cast<int>(priced.task(task).agents.size()) > instance_.task(task).need;
      prices.skip.push_back(is_optional ? price_of(task) : kNever);
    }
    for (const Place goal : choices_[index].goals) {
      const auto known =
          std::ranges::find(multipliers_.on_goals, goal, &std::pair<Place, Time>::first);
      prices.goals.push_back({goal, known->second});
    }
    return prices;
  }

  const Instance& instance_;
  std::vector<RouteBound::Choices> choices_;
  const RouteBound::Multipliers multipliers_;
};

// An agent without a destination that must visit tasks rests on the last task of its sequence.
// Moves the task to the end, and if it is optional, also its stated visit.
void end_on_last_task(const Instance& instance, const PricedInstance& priced, AgentIndex index,
                      AgentPlan& plan) {
  if (instance.agent(index).tasks.empty() || !priced.instance.rests_on_last_stop(index)) return;
  const Place place = instance.world().place(plan.path.back());
  const std::vector<TaskIndex>& tasks = priced.instance.agent(index).tasks;
  const auto is_here = [&](TaskIndex task) { return instance.task(task).cell == place; };
  const auto last = std::ranges::find_if(tasks, is_here);
  GROVE_CHECK(last != tasks.end(), "an agent rests on one of its tasks");
  std::erase_if(plan.work, [&](const WorkTime& work) { return is_here(work.task); });
  std::erase_if(plan.sequence, is_here);
  for (const TaskIndex task : tasks) {
    if (!is_here(task)) continue;
    plan.sequence.push_back(task);
    if (instance.task(task).has_stated_visits()) plan.work.push_back({task, plan.cost, plan.cost});
  }
}

AgentPlan agent_plan_of(const Instance& instance, const PricedInstance& priced, AgentIndex agent,
                        const CountedPath& counted) {
  AgentPlan plan;
  for (const State state : counted.path) plan.path.push_back(priced.instance.world().base(state));
  plan.cost = static_cast<Time>(plan.path.size()) - 1;
  for (const auto& [time, stop] : counted.counted) {
    const auto position = static_cast<std::uint8_t>(stop);
    for (const TaskIndex task : priced.instance.tasks_in_order(agent, {&position, 1})) {
      plan.sequence.push_back(task);
      const Task& of = instance.task(task);
      if (of.has_stated_visits()) plan.work.push_back({task, time - of.duration, time});
    }
  }
  end_on_last_task(instance, priced, agent, plan);
  return plan;
}

}  // namespace

bool can_price_choices(const Instance& instance) {
  for (AgentIndex index = 0; index < instance.agent_count(); ++index) {
    if (!instance.agent(index).has_choice()) continue;
    const auto begun = task_at_start(instance, index);
    if (instance.agent(index).kind > 0 || (begun && !instance.task(*begun).needs_all()))
      return false;
  }
  return true;
}

Pricing price_choices(const Instance& instance, RouteBound& bound, Cost cutoff,
                      const Limits& limits, std::optional<PricedInstance>& priced) {
  if (!can_price_choices(instance)) return Pricing::kNotPossible;
  auto choices = bound.choices_below(cutoff, limits);
  if (!choices) return Pricing::kNotPossible;
  auto multipliers = bound.rounded(limits);
  if (!multipliers) return Pricing::kNotPossible;
  return Reformulation(instance, *std::move(choices), *std::move(multipliers)).make(priced);
}

Plan plan_of(const Instance& instance, const PricedInstance& priced,
             const std::vector<CountedPath>& paths) {
  Plan plan;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    plan.agents.push_back(agent_plan_of(instance, priced, agent, paths[agent]));
    plan.cost += plan.agents.back().cost;
  }
  return plan;
}

}  // namespace grove::detail
