// SPDX-License-Identifier: MIT
// *Relaxation.* A route of agent a starts at its start, visits tasks, and ends at one of its goals
// or, if it has none, at its last task. Each plan contains such routes, whose legs cost at most the
// agents' costs: the tasks in the order in which an agent first visits them, after the task that it
// executes at the start. Together they visit
// each task with a choice of agents at least `need` times, each agent visits the tasks that it must
// visit, and at most one route ends at each goal. Let there be a multiplier m >= 0 for each of
// these conditions. The reduced cost of a route is its cost, minus the multipliers of its visits,
// plus the multiplier of its goal. *Claim: the sum over the agents of the least reduced costs, plus
// the sum of need * m over the conditions on visits, minus the sum of m over the goals, is a lower
// bound on the cost of every plan.* *Proof.* For the routes of a plan the value is at most the sum
// of their costs, because each condition holds and m >= 0.
//
// The least reduced cost of an agent is computed over walks that may repeat visits (ng_walks.h), so
// it is a lower bound for its routes. If there is no minimum, these multipliers give no bound. A
// few of the tasks that the agent must visit are always remembered, and a walk without them does
// not end; so their conditions are exact and have no multiplier.
//
// *Fixing.* If agent a visits t, its least reduced cost in the bound can be replaced by that of a
// walk that visits t. This is at least the least cost of a label at t, plus that of a label at t of
// the reverse walks from the ends, plus the multiplier of t, which both have subtracted. (Of the
// tasks that are always remembered, each is in one of the two labels. Where forward walks leave out
// a leg, the argument in agent_walks.cpp applies to the part of the route before t.) The bound and
// all reduced costs are computed with the same neighbourhoods, because a larger neighbourhood can
// also lower the cost of a walk. If the resulting bound is at
// least the cutoff, no plan that costs less contains the visit. The same holds for a goal and the
// walks that end there.
//
// *Multipliers* are integers in units of 1 / kUnit steps, so all sums are exact. The lower bound is
// rounded up.
#include "assignment/route_bound.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "assignment/agent_walks.h"
#include "assignment/goal_choice.h"
#include "model/assert.h"
#include "model/random.h"
#include "sequencing/ng_walks.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kUnit = AgentWalks::kUnit;
constexpr std::int64_t kNoWalk = NgStops::kNoWalk;
// Tasks in a neighbourhood, at first and at most; fewer if agents times tasks exceed kMany.
constexpr std::pair<int, int> kNeighbors = {4, 8};
constexpr std::pair<int, int> kFewNeighbors = {3, 4};
constexpr std::int64_t kMany = 5000;
constexpr std::int64_t kMaxLegs = 30'000'000;  // between tasks; some seconds to prepare
constexpr double kFirstFactor = 0.5;           // of the step size by Polyak
constexpr double kLastFactor = 0.005;
constexpr double kRetreatFactor = 0.9;  // of the factor, after multipliers without a bound
constexpr int kRoundings = 60;          // sets of whole multipliers that are tried
constexpr int kPatience = 6;            // steps without progress before the factor is halved

}  // namespace

class RouteBound::Relaxation {
 public:
  explicit Relaxation(const Routes& routes)
      : costs_(routes.costs()),
        instance_(costs_.instance()),
        cost_(routes.cost()),
        places_(all_destinations(instance_)) {
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      needs_.push_back(instance_.task(task).needs_all() ? 0 : instance_.task(task).need);
    if (count_legs() > kMaxLegs) return;
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) add_agent(agent);
    start_with(routes);
  }

  void improve(std::int64_t max_effort, const Limits& limits) {
    const std::int64_t end = effort() + max_effort;
    while (effort() < end && can_improve()) {
      switch (evaluate(end - effort(), limits)) {
        case NgWalks::Outcome::kStopped:
          return;
        case NgWalks::Outcome::kNegativeCycle:
          if (has_grown_) continue;
          retreat();
          factor_ *= kRetreatFactor;
          continue;
        case NgWalks::Outcome::kFound:
          break;
      }
      if (!best_ || bound_ > best_->bound) {
        best_ = {bound_, on_visits_, on_goals_};
        failures_ = 0;
      } else if (++failures_ == kPatience) {
        failures_ = 0;
        factor_ /= 2;
      }
      if (!step()) factor_ = 0;
    }
  }

  bool can_improve() const {
    return !agents_.empty() && (!best_ || lower_bound() < cost_) && factor_ > kLastFactor;
  }

  Cost lower_bound() const {
    return best_ ? std::max<Cost>(0, (best_->bound + kUnit - 1) / kUnit) : 0;
  }

  std::optional<std::vector<Choices>> choices_below(Cost cutoff, const Limits& limits) {
    if (!best_) return std::nullopt;
    on_visits_ = best_->on_visits;
    on_goals_ = best_->on_goals;
    // The neighbourhoods have changed since the best bound was found.
    std::vector<std::int64_t> reduced_costs;
    std::int64_t bound = constant();
    for (const AgentData& agent : agents_) {
      if (find_walks(agent, agent.walks.forward, limits) != NgWalks::Outcome::kFound)
        return std::nullopt;
      reduced_costs.push_back(least_reduced_cost(agent));
      bound += reduced_costs.back();
    }
    std::vector<Choices> choices;
    for (const AgentData& agent : agents_) {
      if (find_walks(agent, agent.walks.forward, limits) != NgWalks::Outcome::kFound)
        return std::nullopt;
      const std::int64_t others = bound - reduced_costs[choices.size()];
      const std::int64_t most =
          cutoff >= kInfiniteCost ? kNoWalk - 1 : (cutoff - 1) * kUnit - others;  // for the agent
      choices.push_back({.visits = {}, .goals = goals_within(agent, most)});
      if (!add_visits_within(agent, most, limits, choices.back().visits)) return std::nullopt;
    }
    return choices;
  }

  // Local search from the rounded multipliers: some of those whose condition the walks violate or
  // exceed change by a step.
  std::optional<Multipliers> rounded(std::int64_t max_effort, const Limits& limits) {
    if (!best_) return std::nullopt;
    const std::int64_t end = effort() + max_effort;
    on_visits_ = best_->on_visits;
    on_goals_ = best_->on_goals;
    for (std::int64_t& multiplier : on_visits_)
      multiplier = (multiplier + kUnit / 2) / kUnit * kUnit;
    for (std::int64_t& multiplier : on_goals_)
      multiplier = (multiplier + kUnit / 2) / kUnit * kUnit;
    std::optional<Best> best;
    Random random(0);
    for (int round = 0; round < kRoundings && effort() < end; ++round) {
      if (!evaluate_integral(end, limits)) break;
      if (!best || bound_ >= best->bound) {
        best = {bound_, on_visits_, on_goals_};
      } else {
        on_visits_ = best->on_visits;
        on_goals_ = best->on_goals;
        if (!evaluate_integral(end, limits)) break;
      }
      const auto vary = [&](std::int64_t& multiplier, std::int64_t direction) {
        if (direction == 0 || random.below(4) > 0) return;
        multiplier = std::max<std::int64_t>(0, multiplier + (direction > 0 ? kUnit : -kUnit));
      };
      for (std::size_t i = 0; i < needs_.size(); ++i) vary(on_visits_[i], needs_[i] - visits_[i]);
      for (std::size_t i = 0; i < places_.size(); ++i) vary(on_goals_[i], uses_[i] - 1);
    }
    if (!best || limits.stop_requested()) return std::nullopt;
    Multipliers result;
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      result.on_visits.push_back(static_cast<Time>(best->on_visits[task] / kUnit));
    for (std::size_t i = 0; i < places_.size(); ++i)
      result.on_goals.emplace_back(places_[i], static_cast<Time>(best->on_goals[i] / kUnit));
    return result;
  }

  std::vector<TaskIndex> neighborhood(AgentIndex agent, TaskIndex task) const {
    const AgentWalks& walks = agents_[agent].walks;
    const auto stop = std::ranges::find(walks.tasks, task) - walks.tasks.begin();
    std::vector<TaskIndex> tasks;
    for (const std::int32_t neighbor : walks.forward.stops[stop].neighbors)
      tasks.push_back(walks.tasks[neighbor]);
    return tasks;
  }

 private:
  struct AgentData {
    AgentWalks walks;
    std::vector<std::size_t> conditions;  // by stop: index in needs_, or kExact
    std::vector<std::size_t> goals;       // by position in AgentWalks::goals: index in places_
  };
  static constexpr std::size_t kExact = std::numeric_limits<std::size_t>::max();
  struct Best {
    std::int64_t bound = 0;
    std::vector<std::int64_t> on_visits;
    std::vector<std::int64_t> on_goals;
  };

  std::int64_t effort() const { return walks_.effort(); }

  // The number of legs between the tasks of all agents.
  std::int64_t count_legs() const {
    std::int64_t legs = 0;
    for (const Agent& agent : instance_.agents()) {
      const auto tasks = std::ssize(agent.tasks) + std::ssize(agent.options);
      legs += tasks * tasks;
    }
    return legs;
  }

  void add_agent(AgentIndex index) {
    const bool is_large = std::int64_t{instance_.agent_count()} * instance_.task_count() > kMany;
    AgentData data{.walks = make_agent_walks(costs_, index, is_large ? kFewNeighbors : kNeighbors),
                   .conditions = {},
                   .goals = {}};
    const auto required = std::ssize(instance_.agent(index).tasks);
    for (std::int32_t stop = 0; stop < std::ssize(data.walks.tasks); ++stop) {
      const bool is_exact = stop < data.walks.forward.remembered;
      const bool is_own = !is_exact && stop < required;
      data.conditions.push_back(is_exact ? kExact
                                : is_own ? needs_.size()
                                         : static_cast<std::size_t>(data.walks.tasks[stop]));
      if (is_own) needs_.push_back(1);
    }
    for (const Place goal : data.walks.goals)
      data.goals.push_back(
          static_cast<std::size_t>(std::ranges::lower_bound(places_, goal) - places_.begin()));
    agents_.push_back(std::move(data));
  }

  // The first multipliers: what a route would cost less without the visit, and the prices of the
  // goals for the ends of the routes.
  void start_with(const Routes& routes) {
    on_visits_.assign(needs_.size(), 0);
    std::vector<bool> is_set(needs_.size(), false);
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      for (std::size_t stop = 0; stop < agents_[agent].conditions.size(); ++stop) {
        const std::size_t condition = agents_[agent].conditions[stop];
        const TaskIndex task = agents_[agent].walks.tasks[stop];
        if (condition == kExact || !routes.visits(agent, task)) continue;
        Routes without = routes;
        const std::int64_t saved = std::max<Cost>(0, without.remove(agent, task)) * kUnit;
        std::int64_t& multiplier = on_visits_[condition];
        multiplier = is_set[condition] ? std::min(multiplier, saved) : saved;
        is_set[condition] = true;
      }
    on_goals_.assign(places_.size(), 0);
    const auto choice = cheapest_goals(instance_, [&](AgentIndex agent, Place goal) {
      return Cost{routes.leg_to_goal(agent, goal)};
    });
    if (!choice) return;
    for (std::size_t i = 0; i < places_.size(); ++i)
      on_goals_[i] = std::min<Cost>(choice->prices[i], kNever) * kUnit;
  }

  // Computes the bound for the current multipliers, and counts the visits and the uses of goals.
  NgWalks::Outcome evaluate(std::int64_t max_effort, const Limits& limits) {
    const std::int64_t end = effort() + max_effort;
    visits_.assign(needs_.size(), 0);
    uses_.assign(places_.size(), 0);
    bound_ = constant();
    for (AgentData& agent : agents_) {
      const auto outcome = find_walks(agent, agent.walks.forward, limits, end - effort());
      if (outcome == NgWalks::Outcome::kNegativeCycle) {
        agent_of_cycle_ = &agent;
        has_grown_ = agent.walks.forbid_cycle(costs_, walks_.cycle());
      }
      if (outcome != NgWalks::Outcome::kFound) return outcome;
      NgWalks::LabelId last = NgWalks::kStart;
      bound_ += least_reduced_cost(agent, &last);
      if (const auto cycle = walks_.cycle_before(last); !cycle.empty())
        agent.walks.forbid_cycle(costs_, cycle);
    }
    return NgWalks::Outcome::kFound;
  }

  // As evaluate(), for integral multipliers. While a cycle has a negative cost, lowers the greatest
  // multiplier of its visits. Returns false after about `end` labels in total, or at a limit.
  bool evaluate_integral(std::int64_t end, const Limits& limits) {
    for (;;) {
      const auto outcome = evaluate(std::max<std::int64_t>(end - effort(), 1), limits);
      if (outcome != NgWalks::Outcome::kNegativeCycle) return outcome == NgWalks::Outcome::kFound;
      if (has_grown_) continue;
      std::int64_t* greatest = nullptr;
      for (const std::int32_t stop : walks_.cycle()) {
        const std::size_t condition = agent_of_cycle_->conditions[stop];
        if (condition == kExact) continue;
        std::int64_t& multiplier = on_visits_[condition];
        if (greatest == nullptr || multiplier > *greatest) greatest = &multiplier;
      }
      GROVE_CHECK(greatest != nullptr && *greatest >= kUnit, "a negative cycle has a multiplier");
      *greatest -= kUnit;
    }
  }

  // The part of the bound that does not depend on the walks.
  std::int64_t constant() const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < needs_.size(); ++i) sum += needs_[i] * on_visits_[i];
    for (const std::int64_t multiplier : on_goals_) sum -= multiplier;
    return sum;
  }

  NgWalks::Outcome find_walks(const AgentData& agent, const NgStops& stops, const Limits& limits,
                              std::int64_t max_effort = kNoWalk) {
    prizes_.clear();
    for (const std::size_t condition : agent.conditions)
      prizes_.push_back(condition == kExact ? 0 : on_visits_[condition]);
    return walks_.find(stops, prizes_, max_effort, limits);
  }

  // Of the labels found, the least reduced cost to an end. Counts the visits of the walk.
  std::int64_t least_reduced_cost(const AgentData& agent, NgWalks::LabelId* end_label = nullptr) {
    const NgWalks::Memory always = (NgWalks::Memory{1} << agent.walks.forward.remembered) - 1;
    std::pair<std::int64_t, std::size_t> best{kNoWalk, 0};
    if (always == 0) best = cost_to_end(agent, agent.walks.start_to_goals);
    NgWalks::LabelId last = NgWalks::kStart;
    for (const NgWalks::LabelId label : walks_.labels()) {
      if ((walks_.memory(label) & always) != always) continue;
      auto end = cost_to_end(agent, agent.walks.to_goals[walks_.stop(label)]);
      end.first += walks_.cost(label);
      if (end.first >= best.first) continue;
      best = end;
      last = label;
    }
    if (end_label) *end_label = last;
    if (!agent.goals.empty() && best.first < kNoWalk) ++uses_[agent.goals[best.second]];
    for (; last != NgWalks::kStart; last = walks_.parent(last)) {
      const std::size_t condition = agent.conditions[walks_.stop(last)];
      if (condition != kExact) ++visits_[condition];
    }
    return best.first;
  }

  // The least cost to an end, and the position of the goal.
  std::pair<std::int64_t, std::size_t> cost_to_end(const AgentData& agent,
                                                   const std::vector<Time>& to_goals) const {
    std::pair<std::int64_t, std::size_t> best{agent.goals.empty() ? 0 : kNoWalk, 0};
    for (std::size_t i = 0; i < to_goals.size(); ++i) {
      if (to_goals[i] >= kNever) continue;
      const std::int64_t cost = to_goals[i] * kUnit + on_goals_[agent.goals[i]];
      if (cost < best.first) best = {cost, i};
    }
    return best;
  }

  // The goals of walks that cost at most `most`.
  std::vector<Place> goals_within(const AgentData& agent, std::int64_t most) const {
    const NgWalks::Memory always = (NgWalks::Memory{1} << agent.walks.forward.remembered) - 1;
    std::vector<Place> goals;
    for (std::size_t i = 0; i < agent.goals.size(); ++i) {
      const auto is_within = [&](std::int64_t before, Time steps) {
        return steps < kNever && before + steps * kUnit + on_goals_[agent.goals[i]] <= most;
      };
      const auto ends_within = [&](NgWalks::LabelId label) {
        return (walks_.memory(label) & always) == always &&
               is_within(walks_.cost(label), agent.walks.to_goals[walks_.stop(label)][i]);
      };
      if ((always == 0 && is_within(0, agent.walks.start_to_goals[i])) ||
          std::ranges::any_of(walks_.labels(), ends_within))
        goals.push_back(agent.walks.goals[i]);
    }
    return goals;
  }

  // Adds the optional visits of walks that cost at most `most`. Returns false if this is not known.
  bool add_visits_within(const AgentData& agent, std::int64_t most, const Limits& limits,
                         std::vector<TaskIndex>& visits) {
    const std::vector<std::int64_t> before = least_costs(agent);
    std::vector<std::int64_t> to_end;
    for (const std::vector<Time>& to_goals : agent.walks.to_goals)
      to_end.push_back(cost_to_end(agent, to_goals).first);
    const NgStops reversed = agent.walks.reversed(costs_, to_end);
    if (find_walks(agent, reversed, limits) != NgWalks::Outcome::kFound) return false;
    const std::vector<std::int64_t> after = least_costs(agent);
    const std::size_t sets = std::size_t{1} << agent.walks.forward.remembered;
    const auto required = instance_.agent(agent.walks.agent).tasks.size();
    for (std::size_t stop = required; stop < agent.conditions.size(); ++stop) {
      const TaskIndex task = agent.walks.tasks[stop];
      std::int64_t least = kNoWalk;
      for (std::size_t set = 0; set < sets; ++set)
        least = std::min(least, before[stop * sets + set] + after[(stop + 1) * sets - 1 - set]);
      if (least < kNoWalk && least + on_visits_[task] <= most) visits.push_back(task);
    }
    std::ranges::sort(visits);
    return true;
  }

  // The least costs of the labels found, by stop and set of always remembered visits.
  std::vector<std::int64_t> least_costs(const AgentData& agent) const {
    const std::size_t sets = std::size_t{1} << agent.walks.forward.remembered;
    std::vector<std::int64_t> least(agent.conditions.size() * sets, kNoWalk);
    for (const NgWalks::LabelId label : walks_.labels()) {
      const std::size_t set = walks_.memory(label) & (sets - 1);
      std::int64_t& cost = least[static_cast<std::size_t>(walks_.stop(label)) * sets + set];
      cost = std::min(cost, walks_.cost(label));
    }
    return least;
  }

  // Changes the multipliers along the subgradient, with the step size by Polyak. Returns false if
  // the subgradient is 0.
  bool step() {
    std::int64_t norm = 0;
    for (std::size_t i = 0; i < needs_.size(); ++i)
      norm += (needs_[i] - visits_[i]) * (needs_[i] - visits_[i]);
    for (const std::int64_t uses : uses_) norm += (uses - 1) * (uses - 1);
    if (norm == 0) return false;
    const double length =
        factor_ * static_cast<double>(cost_ * kUnit - bound_) / static_cast<double>(norm);
    const auto move = [&](std::int64_t& multiplier, std::int64_t direction) {
      multiplier += static_cast<std::int64_t>(length * static_cast<double>(direction));
      multiplier = std::max<std::int64_t>(multiplier, 0);
    };
    for (std::size_t i = 0; i < needs_.size(); ++i) move(on_visits_[i], needs_[i] - visits_[i]);
    for (std::size_t i = 0; i < places_.size(); ++i) move(on_goals_[i], uses_[i] - 1);
    return true;
  }

  // The multipliers give no bound: moves them towards the best ones, or towards 0.
  void retreat() {
    for (std::size_t i = 0; i < on_visits_.size(); ++i)
      on_visits_[i] = best_ ? (on_visits_[i] + best_->on_visits[i]) / 2 : on_visits_[i] * 7 / 8;
    for (std::size_t i = 0; best_ && i < on_goals_.size(); ++i)
      on_goals_[i] = (on_goals_[i] + best_->on_goals[i]) / 2;
  }

  const RouteCosts& costs_;
  const Instance& instance_;
  const Cost cost_;                  // of the routes
  const std::vector<Place> places_;  // the destinations of all agents
  std::vector<std::int64_t> needs_;  // by condition: the least number of visits; first by task
  std::vector<AgentData> agents_;
  std::vector<std::int64_t> on_visits_;  // multipliers by condition
  std::vector<std::int64_t> on_goals_;   // and by index in places_
  std::optional<Best> best_;
  double factor_ = kFirstFactor;
  int failures_ = 0;                           // steps since the last progress
  const AgentData* agent_of_cycle_ = nullptr;  // of the last evaluation without a minimum
  bool has_grown_ = false;  // a neighbourhood has, in the last evaluation without a minimum
  NgWalks walks_;
  // Of the current evaluation.
  std::int64_t bound_ = 0;
  std::vector<std::int64_t> visits_;  // by condition
  std::vector<std::int64_t> uses_;    // by index in places_
  std::vector<std::int64_t> prizes_;  // of one agent, by stop
};

RouteBound::RouteBound(const Routes& routes) : relaxation_(std::make_unique<Relaxation>(routes)) {}
RouteBound::~RouteBound() = default;

void RouteBound::improve(std::int64_t max_effort, const Limits& limits) {
  relaxation_->improve(max_effort, limits);
}

bool RouteBound::can_improve() const {
  return relaxation_->can_improve();
}

std::optional<std::vector<RouteBound::Choices>> RouteBound::choices_below(Cost cutoff,
                                                                          const Limits& limits) {
  return relaxation_->choices_below(cutoff, limits);
}

std::optional<RouteBound::Multipliers> RouteBound::rounded(std::int64_t max_effort,
                                                           const Limits& limits) {
  return relaxation_->rounded(max_effort, limits);
}

std::vector<TaskIndex> RouteBound::neighborhood(AgentIndex agent, TaskIndex task) const {
  return relaxation_->neighborhood(agent, task);
}

Cost RouteBound::lower_bound() const {
  return relaxation_->lower_bound();
}

}  // namespace grove::detail
