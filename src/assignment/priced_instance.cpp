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
// *Stops.* The tasks of an agent on one place that take no time have one stop, and the agent counts
// all of them or none. If an agent of C_t has another task at the stop of t, then m_t = 0. (Tasks
// that take time have their own stops.) An agent is at the stop of t before it begins a task that
// takes time on the same place, unless it starts at work there; this case is refused.
//
// An agent that starts while it executes an optional task t completes it, and must count it. Then
// m_t = 0, because the visits of others that rest on its place can exceed the need.
//
// If fewer than n_t agents are left in C_t, or an agent with a choice of goals has none left, there
// is no plan below the cutoff.
//
// An agent without a destination that must visit a task rests on a task that it has visited. If it
// rests on an optional task that it does not count, this visit is stated as well; it is a surplus
// visit, and the agent has paid the price of leaving it out. If the task takes time, the agent must
// have counted it (AgentPrices::rest_requires). This excludes no plan: at most one agent rests on
// the place, so its visit can be one of the n_t that are counted.
#include "assignment/priced_instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "assignment/goal_choice.h"
#include "assignment/routes.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr Time kMaxPrice = 1 << 20;
constexpr std::int64_t kRoundingEffort = 100'000'000;  // about 0.6 s

// True if the agent has an optional task on the place of another one.
bool shares_places(const Instance& instance, const Agent& agent) {
  std::set<Place> places;
  for (const TaskIndex task : agent.tasks) places.insert(instance.task(task).cell);
  return std::ranges::any_of(agent.options, [&](TaskIndex task) {
    return !places.insert(instance.task(task).cell).second;
  });
}

// The tasks without a duration on the place of the stop, or the one task that takes time there.
std::vector<TaskIndex> tasks_at(const Instance& priced, AgentIndex index, int stop) {
  const Agent& agent = priced.agent(index);
  const TaskIndex of_stop = agent.stops[stop];
  std::vector<TaskIndex> tasks{of_stop};
  if (priced.task(of_stop).duration > 0) return tasks;
  for (const TaskIndex task : agent.tasks)
    if (task != of_stop && priced.task(task).cell == priced.task(of_stop).cell &&
        priced.task(task).duration == 0)
      tasks.push_back(task);
  return tasks;
}

int stop_of(const Instance& priced, AgentIndex index, TaskIndex task) {
  const std::vector<TaskIndex>& stops = priced.agent(index).stops;
  const auto visits = [&](TaskIndex stop) {
    return stop == task || (priced.task(task).duration == 0 && priced.task(stop).duration == 0 &&
                            priced.task(stop).cell == priced.task(task).cell);
  };
  return static_cast<int>(std::ranges::find_if(stops, visits) - stops.begin());
}

class Reformulation {
 public:
  Reformulation(const Instance& instance, const RouteBound& bound,
                std::vector<RouteBound::Choices> choices)
      : instance_(instance), bound_(bound), choices_(std::move(choices)) {
    keep_begun_visits();
  }

  bool is_possible() const {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      if (!has_room(agent)) return false;
    return true;
  }

  // Precondition: is_possible().
  Pricing make(RouteBound::Multipliers multipliers, std::optional<PricedInstance>& priced) {
    multipliers_ = std::move(multipliers);
    remove_goals_of_others();
    InstanceBuilder builder = InstanceBuilder::like(instance_);
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      AgentSpec spec = instance_.spec(agent);
      if (!spec.goals.empty()) spec.goals = choices_[agent].goals;
      if (instance_.agent(agent).goals.size() > 0 && spec.goals.empty()) return Pricing::kNoPlan;
      builder.add_agent(std::move(spec));
      if (shares_places(instance_, instance_.agent(agent))) builder.may_leave_out_stops(agent);
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

  // Every plan states the visit of an agent that starts while it executes an optional task.
  void keep_begun_visits() {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      const auto begun = task_at_start(instance_, agent);
      if (!begun || instance_.task(*begun).needs_all() || may_visit(agent, *begun)) continue;
      std::vector<TaskIndex>& visits = choices_[agent].visits;
      visits.insert(std::ranges::upper_bound(visits, *begun), *begun);
    }
  }

  bool has_room(AgentIndex index) const {
    const Agent& agent = instance_.agent(index);
    if (!agent.has_choice()) return true;
    std::vector<TaskIndex> tasks = choices_[index].visits;
    tasks.insert(tasks.end(), agent.tasks.begin(), agent.tasks.end());
    return tasks.size() <= kMaxTasksPerAgent &&
           !(shares_places(instance_, agent) && is_at_work_on_another(index, tasks));
  }

  // A task without a duration on the start is visited at time 0, although the agent is at work.
  bool is_at_work_on_another(AgentIndex index, const std::vector<TaskIndex>& tasks) const {
    const auto begun = task_at_start(instance_, index);
    return begun && std::ranges::any_of(tasks, [&](TaskIndex task) {
             return instance_.task(task).duration == 0 &&
                    instance_.task(task).cell == instance_.task(*begun).cell;
           });
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
      const Time multiplier = price_of(priced.instance, task);
      Prices::Need& made = prices.needs.emplace_back();
      made.task = task;
      made.price = multiplier;
      made.count = need;
      made.is_exact = multiplier > 0;
      for (const AgentIndex agent : of.agents)
        made.visits.push_back({agent, stop_of(priced.instance, agent, task)});
      prices.constant += multiplier * surplus;
    }
    for (const auto& [place, price] : multipliers_.on_goals)
      if (price > 0 && is_choice(place)) {
        prices.goals.push_back({place, price});
        prices.constant += price;
      }
  }

  // 0 if the task shares a stop, or if an agent starts while it executes the task. At most
  // kMaxPrice, so that sums are far below kNever.
  Time price_of(const Instance& priced, TaskIndex task) const {
    const bool is_free = std::ranges::any_of(priced.task(task).agents, [&](AgentIndex agent) {
      return task_at_start(instance_, agent) == task ||
             tasks_at(priced, agent, stop_of(priced, agent, task)).size() > 1;
    });
    return is_free ? 0 : std::min(multipliers_.on_visits[task], kMaxPrice);
  }

  // The price of leaving out a stop: kNever if the agent must visit one of its tasks.
  Time price_of_skip(const Instance& priced, AgentIndex agent, int stop) const {
    Time price = 0;
    for (const TaskIndex task : tasks_at(priced, agent, stop)) {
      const Task& of = priced.task(task);
      const bool is_needed = static_cast<int>(of.agents.size()) == instance_.task(task).need;
      if (is_needed || std::ranges::binary_search(choices_[agent].required, task) ||
          task_at_start(instance_, agent) == task)
        return kNever;
      price += price_of(priced, task);
    }
    return price;
  }

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
    if (!agent.has_destination() && !agent.is_idle())
      prices.rest_requires = rest_requires(priced, index);
    for (int stop = 0; stop < std::ssize(priced.agent(index).stops); ++stop)
      prices.skip.push_back(price_of_skip(priced, index, stop));
    prices.neighborhoods = neighborhoods(priced, index);
    for (const Place goal : choices_[index].goals) {
      const auto known =
          std::ranges::find(multipliers_.on_goals, goal, &std::pair<Place, Time>::first);
      prices.goals.push_back({goal, known->second});
    }
    return prices;
  }

  std::vector<StopSet> neighborhoods(const Instance& priced, AgentIndex index) const {
    const Agent& agent = priced.agent(index);
    std::vector<StopSet> sets;
    for (const TaskIndex stop : agent.stops) {
      StopSet& set = sets.emplace_back(0);
      for (const TaskIndex task : bound_.neighborhood(index, stop))
        if (std::ranges::count(agent.tasks, task) > 0) set |= bit(stop_of(priced, index, task));
    }
    return sets;
  }

  // The stops on places where all tasks of the agent take time and are optional.
  StopSet rest_requires(const Instance& priced, AgentIndex index) const {
    const Agent& agent = priced.agent(index);
    const auto always_permits_rest = [&](TaskIndex task) {
      return priced.task(task).duration == 0 || instance_.task(task).needs_all();
    };
    StopSet required = 0;
    for (std::size_t stop = 0; stop < agent.stops.size(); ++stop) {
      const Place place = priced.task(agent.stops[stop]).cell;
      if (std::ranges::none_of(agent.tasks, [&](TaskIndex task) {
            return priced.task(task).cell == place && always_permits_rest(task);
          }))
        required |= bit(static_cast<int>(stop));
    }
    return required;
  }

  const Instance& instance_;
  const RouteBound& bound_;
  std::vector<RouteBound::Choices> choices_;
  RouteBound::Multipliers multipliers_;
};

// An agent without a destination that must visit tasks rests on a task that it has visited. If none
// of its tasks takes time, this is the last task of its sequence.
void end_on_a_task(const Instance& instance, const PricedInstance& priced, AgentIndex index,
                   AgentPlan& plan) {
  const Agent& agent = instance.agent(index);
  if (agent.has_destination() || agent.is_idle()) return;
  const Place place = instance.world().place(plan.path.back());
  const auto is_here = [&](TaskIndex task) { return instance.task(task).cell == place; };
  if (priced.instance.rests_on_last_stop(index)) {
    std::erase_if(plan.work, [&](const WorkTime& work) { return is_here(work.task); });
    std::erase_if(plan.sequence, is_here);
  } else if (std::ranges::any_of(plan.sequence, is_here)) {
    return end_on_the_place_of_rest(instance, index, plan);
  }
  for (const TaskIndex task : priced.instance.agent(index).tasks) {
    if (!is_here(task) || instance.task(task).duration > 0) continue;
    plan.sequence.push_back(task);
    if (instance.task(task).has_stated_visits()) plan.work.push_back({task, plan.cost, plan.cost});
  }
  GROVE_CHECK(std::ranges::any_of(plan.sequence, is_here), "an agent rests on one of its tasks");
}

std::vector<TaskIndex> tasks_at(const Instance& instance, const PricedInstance& priced,
                                AgentIndex agent, int stop) {
  if (shares_places(instance, instance.agent(agent))) return tasks_at(priced.instance, agent, stop);
  const auto position = static_cast<std::uint8_t>(stop);
  return priced.instance.tasks_in_order(agent, {&position, 1});
}

AgentPlan agent_plan_of(const Instance& instance, const PricedInstance& priced, AgentIndex agent,
                        const CountedPath& counted) {
  AgentPlan plan;
  for (const State state : counted.path) plan.path.push_back(priced.instance.world().base(state));
  plan.cost = static_cast<Time>(plan.path.size()) - 1;
  for (const auto& [time, stop] : counted.counted) {
    for (const TaskIndex task : tasks_at(instance, priced, agent, stop)) {
      plan.sequence.push_back(task);
      const Task& of = instance.task(task);
      if (of.has_stated_visits()) plan.work.push_back({task, time - of.duration, time});
    }
  }
  end_on_a_task(instance, priced, agent, plan);
  return plan;
}

std::optional<std::vector<RouteBound::Choices>> all_choices(const Instance& instance) {
  std::vector<RouteBound::Choices> choices;
  for (const Agent& agent : instance.agents())
    choices.push_back({.visits = agent.options, .required = {}, .goals = agent.goals});
  return choices;
}

bool starts_with_option(const Instance& instance, AgentIndex index) {
  const auto begun = task_at_start(instance, index);
  return begun && !instance.task(*begun).needs_all();
}

}  // namespace

std::optional<Choice> find_uncertified_choice(const Instance& instance) {
  for (AgentIndex index = 0; index < instance.agent_count(); ++index) {
    const Agent& agent = instance.agent(index);
    if (!agent.has_choice()) continue;
    const auto refused = [&](std::string_view what, std::string_view expected) {
      return Choice{fmt::format("agents/{}", index),
                    fmt::format("agent '{}' has a choice and {}", agent.id, what),
                    std::string(expected)};
    };
    if (agent.kind > 0) return refused("needs time to turn", "agents that turn freely");
    if (starts_with_option(instance, index))
      return refused("executes an optional task at the start", "a task that it must visit");
    if (std::ssize(agent.tasks) + std::ssize(agent.options) > kMaxCertifiedTasks)
      return refused(fmt::format("more than {} tasks", kMaxCertifiedTasks), "fewer tasks");
    if (shares_places(instance, agent))
      return refused("an optional task on the place of another one", "distinct places");
    if (!agent.has_destination() && !agent.tasks.empty())
      return refused("must visit tasks, but has no goal", "an agent with a goal");
  }
  return std::nullopt;
}

Pricing price_choices(const Instance& instance, RouteBound& bound, Cost cutoff, Fixing fixing,
                      const Limits& limits, std::optional<PricedInstance>& priced) {
  auto choices =
      fixing == Fixing::kNone ? all_choices(instance) : bound.choices_below(cutoff, limits);
  if (!choices) return Pricing::kNotPossible;
  Reformulation reformulation(instance, bound, *std::move(choices));
  if (!reformulation.is_possible()) return Pricing::kNotPossible;
  auto multipliers = bound.rounded(kRoundingEffort, limits);
  if (!multipliers) return Pricing::kNotPossible;
  return reformulation.make(*std::move(multipliers), priced);
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
