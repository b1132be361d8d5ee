// SPDX-License-Identifier: MIT
// *Relaxation.* A route of agent a starts at its start, visits tasks, and ends at one of its goals
// or, if it has none, at its last task. Each plan contains such routes: an agent's route has the
// tasks in the order in which the agent first visits them, after the task that it executes at the
// start. The cost of a route, the sum of its legs, is at most the agent's cost in the plan.
// Together the routes visit each task with a choice of agents `need` times, each agent visits the
// tasks that it must visit, and at most one route ends at each goal. (The bound needs only `need`
// visits or more; decisions need exactly as many. So surplus visits are left out. The visit of an
// agent that rests on the task is kept, because in the search of a node (priced_instance.h) an
// agent rests only on tasks that are left to it. At most one agent rests there, and need >= 1.) Let
// there be a multiplier m >= 0 for each of these conditions. The reduced cost of a route is its
// cost, minus the multipliers of its visits, plus the multiplier of its goal. *Claim: the sum over
// the agents of the least reduced costs, plus the sum of need * m over the conditions on visits,
// minus the sum of m over the goals, is a lower bound on the cost of every plan.* *Proof.* With the
// routes of a plan instead of the least reduced costs, this sum is at most the sum of their costs,
// because each condition holds and m >= 0.
//
// The least reduced cost of an agent is computed over walks that may repeat visits (ng_walks.h), so
// it is a lower bound for its routes. If there is no minimum, these multipliers give no bound. A
// few of the tasks that the agent must visit are always remembered, and a walk without them does
// not end; so their conditions are exact and have no multiplier.
//
// *Fixing.* If agent a visits t, its term in the bound can be replaced by a lower bound on the
// reduced cost of its routes through t. Split such a route at t. The part up to t costs at least
// the least reduced cost of a forward label at t. The part from t costs at least that of a label at
// t of the reverse walks from the ends. Both subtract the multiplier of t, so it is added once.
// (Each task that is always remembered is in exactly one of the two parts, so only labels with
// complementary sets are combined.) The bound minus the agent's term must be the sum over the other
// agents, so both are computed with the same neighbourhoods. If the resulting bound is at least the
// cutoff, no plan that costs less contains the visit. The same holds for a goal and the walks that
// end there, and for a leg from t to u: the label at t, the leg, and the reverse label at u.
//
// It remains to show that some forward label at t has at most the reduced cost of the route up to
// t, although forward walks leave out some legs (agent_walks.cpp). If the agent needs time to turn,
// they leave out none. Otherwise choose routes such that no later stop w without a duration lies
// strictly inside a shortest path of a leg from u to v, that is, in neither the cell of u nor that
// of v. (Such routes exist: otherwise move w between u and v. By the triangle inequality the route
// costs no more. The first leg that changes becomes shorter, so the sequence of leg costs decreases
// lexicographically, and this ends.) By induction there is a label at each stop of the route up to
// t whose reduced cost is at most that of the route so far, and which remembers no later stop.
// Between stops x and y of the route it may have to go through further stops w. These lie strictly
// inside shortest paths from x to y. So they are no later stops, add no length, and have prizes >=
// 0. An always remembered w is thus an earlier stop of the route, so the label has the same always
// remembered tasks as the route. A label that dominates it has the same such tasks, remembers no
// more, and costs no more.
//
// *After fixing* walks have the legs that are left, without further conditions (NgStops::Leg). They
// include the legs of the chosen routes of each plan that costs less than the cutoff. The chosen
// routes of a plan depend neither on the multipliers nor on the cutoff, so fixing can be repeated
// with other multipliers and a lower cutoff.
//
// *Decisions* partition the plans by the visits and goals of their routes: those in which agent a
// visits t, and the others; those in which it ends on g, and the others. If a must visit t, its
// visit has a condition of its own, and the other agents visit t need - 1 times.
#include "assignment/route_relaxation.h"

#include <algorithm>

#include "assignment/goal_choice.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kUnit = AgentWalks::kUnit;
constexpr std::int64_t kNoWalk = NgStops::kNoWalk;
// Tasks in a neighbourhood, at first and at most; fewer if agents times tasks exceed kMany.
constexpr std::pair<int, int> kNeighbors = {4, 8};
constexpr std::pair<int, int> kFewNeighbors = {3, 4};
constexpr std::int64_t kMany = 5000;
constexpr std::int64_t kMaxLegs = 30'000'000;  // between tasks; some seconds to prepare
constexpr double kNewShare = 0.1;              // weight of an evaluation in the shares

// The number of legs between the tasks of all agents.
std::int64_t count_legs(const Instance& instance) {
  std::int64_t legs = 0;
  for (const Agent& agent : instance.agents()) {
    const auto tasks = std::ssize(agent.tasks) + std::ssize(agent.options);
    legs += tasks * tasks;
  }
  return legs;
}

}  // namespace

RouteRelaxation::RouteRelaxation(const RouteCosts& costs)
    : costs_(&costs),
      instance_(&costs.instance()),
      places_(all_destinations(costs.instance())),
      walks_(std::make_shared<NgWalks>()) {
  for (TaskIndex task = 0; task < instance_->task_count(); ++task) {
    needs_.push_back(instance_->task(task).needs_all() ? 0 : instance_->task(task).need);
    tasks_.push_back(task);
  }
  for (const Agent& agent : instance_->agents())
    choices_.push_back({.visits = agent.options, .required = {}, .goals = agent.goals});
  if (count_legs(*instance_) > kMaxLegs) return;
  for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent) add_agent(agent);
}

void RouteRelaxation::add_agent(AgentIndex index) {
  const bool is_large = std::int64_t{instance_->agent_count()} * instance_->task_count() > kMany;
  AgentData data{.walks = make_agent_walks(*costs_, index, is_large ? kFewNeighbors : kNeighbors),
                 .conditions = {},
                 .goals = {},
                 .shares = {},
                 .shares_of_goals = {}};
  const auto required = std::ssize(instance_->agent(index).tasks);
  for (std::int32_t stop = 0; stop < std::ssize(data.walks.tasks); ++stop) {
    const TaskIndex task = data.walks.tasks[stop];
    const bool is_exact = stop < data.walks.forward.remembered;
    const bool is_own = !is_exact && stop < required;
    data.conditions.push_back(is_exact ? kExact
                              : is_own ? needs_.size()
                                       : static_cast<std::size_t>(task));
    if (!is_own) continue;
    needs_.push_back(1);
    tasks_.push_back(task);
  }
  for (const Place goal : data.walks.goals)
    data.goals.push_back(
        static_cast<std::size_t>(std::ranges::lower_bound(places_, goal) - places_.begin()));
  data.shares.resize(data.walks.tasks.size());
  data.shares_of_goals.resize(data.walks.goals.size());
  agents_.push_back(std::move(data));
}

std::optional<std::size_t> RouteRelaxation::condition(AgentIndex agent, TaskIndex task) const {
  const std::size_t condition = agents_[agent].conditions[stop_of(agent, task)];
  return condition == kExact ? std::nullopt : std::optional(condition);
}

std::int32_t RouteRelaxation::stop_of(AgentIndex agent, TaskIndex task) const {
  const std::vector<TaskIndex>& tasks = agents_[agent].walks.tasks;
  return static_cast<std::int32_t>(std::ranges::find(tasks, task) - tasks.begin());
}

NgWalks::Outcome RouteRelaxation::evaluate(const RouteMultipliers& multipliers,
                                           std::int64_t max_effort, const Limits& limits) {
  multipliers_ = &multipliers;
  const std::int64_t end = effort() + max_effort;
  visits_.assign(needs_.size(), 0);
  uses_.assign(places_.size(), 0);
  bound_ = constant();
  for (AgentData& agent : agents_) {
    const auto outcome = find_walks(agent, agent.walks.forward, limits, end - effort());
    if (outcome == NgWalks::Outcome::kNegativeCycle) {
      const std::vector<std::int32_t> cycle = walks_->cycle();
      conditions_of_cycle_.clear();
      for (const std::int32_t stop : cycle)
        if (agent.conditions[stop] != kExact)
          conditions_of_cycle_.push_back(agent.conditions[stop]);
      has_grown_ = agent.walks.forbid_cycle(*costs_, cycle);
    }
    if (outcome != NgWalks::Outcome::kFound) return outcome;
    NgWalks::LabelId last = NgWalks::kStart;
    const std::int64_t least = take_best_walk(agent, &last);
    if (least >= kNoWalk) {
      bound_ = kNoWalk;
      return outcome;
    }
    bound_ += least;
    if (const auto cycle = walks_->cycle_before(last); !cycle.empty())
      agent.walks.forbid_cycle(*costs_, cycle);
  }
  return NgWalks::Outcome::kFound;
}

// The part of the bound that does not depend on the walks.
std::int64_t RouteRelaxation::constant() const {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < needs_.size(); ++i) sum += needs_[i] * multipliers_->on_visits[i];
  for (const std::int64_t multiplier : multipliers_->on_goals) sum -= multiplier;
  return sum;
}

NgWalks::Outcome RouteRelaxation::find_walks(const AgentData& agent, const NgStops& stops,
                                             const Limits& limits, std::int64_t max_effort) {
  prizes_.clear();
  for (const std::size_t condition : agent.conditions)
    prizes_.push_back(condition == kExact ? 0 : multipliers_->on_visits[condition]);
  return walks_->find(stops, prizes_, max_effort, limits);
}

// Of the labels found, the least reduced cost to an end. Counts the visits of the walk.
std::int64_t RouteRelaxation::take_best_walk(AgentData& agent, NgWalks::LabelId* end_label) {
  const NgWalks::Memory always = (NgWalks::Memory{1} << agent.walks.forward.remembered) - 1;
  std::pair<std::int64_t, std::size_t> best{kNoWalk, 0};
  if (always == 0) best = cost_to_end(agent, agent.walks.start_to_goals);
  NgWalks::LabelId last = NgWalks::kStart;
  for (const NgWalks::LabelId label : walks_->labels()) {
    if ((walks_->memory(label) & always) != always) continue;
    auto end = cost_to_end(agent, agent.walks.to_goals[walks_->stop(label)]);
    if (end.first >= kNoWalk) continue;
    end.first += walks_->cost(label);
    if (end.first >= best.first) continue;
    best = end;
    last = label;
  }
  *end_label = last;
  if (best.first >= kNoWalk) return kNoWalk;
  for (double& share : agent.shares) share *= 1 - kNewShare;
  for (double& share : agent.shares_of_goals) share *= 1 - kNewShare;
  if (!agent.goals.empty()) {
    ++uses_[agent.goals[best.second]];
    agent.shares_of_goals[best.second] += kNewShare;
  }
  for (; last != NgWalks::kStart; last = walks_->parent(last)) {
    const std::int32_t stop = walks_->stop(last);
    agent.shares[stop] += kNewShare;
    if (agent.conditions[stop] != kExact) ++visits_[agent.conditions[stop]];
  }
  return best.first;
}

// The least cost to an end, and the position of the goal.
std::pair<std::int64_t, std::size_t> RouteRelaxation::cost_to_end(
    const AgentData& agent, const std::vector<Time>& to_goals) const {
  std::pair<std::int64_t, std::size_t> best{agent.goals.empty() ? 0 : kNoWalk, 0};
  for (std::size_t i = 0; i < to_goals.size(); ++i) {
    if (to_goals[i] >= kNever) continue;
    const std::int64_t cost = to_goals[i] * kUnit + multipliers_->on_goals[agent.goals[i]];
    if (cost < best.first) best = {cost, i};
  }
  return best;
}

// The least costs of the labels found, by stop and set of always remembered visits.
std::vector<std::int64_t> RouteRelaxation::least_costs(const AgentData& agent) const {
  const std::size_t sets = std::size_t{1} << agent.walks.forward.remembered;
  std::vector<std::int64_t> least(agent.conditions.size() * sets, kNoWalk);
  for (const NgWalks::LabelId label : walks_->labels()) {
    const std::size_t set = walks_->memory(label) & (sets - 1);
    std::int64_t& cost = least[static_cast<std::size_t>(walks_->stop(label)) * sets + set];
    cost = std::min(cost, walks_->cost(label));
  }
  return least;
}

RouteRelaxation::Reach RouteRelaxation::reach_of(const AgentData& agent) const {
  Reach reach{.least = kNoWalk, .to_stops = least_costs(agent), .to_goals = {}};
  const std::size_t sets = std::size_t{1} << agent.walks.forward.remembered;
  // With all visits that are always remembered.
  const auto to_stop = [&](std::size_t stop) { return reach.to_stops[(stop + 1) * sets - 1]; };
  reach.to_goals.assign(agent.goals.size(), kNoWalk);
  const auto extend = [&](std::int64_t cost, const std::vector<Time>& to_goals) {
    for (std::size_t i = 0; i < to_goals.size(); ++i) {
      if (to_goals[i] >= kNever) continue;
      const std::int64_t end = cost + to_goals[i] * kUnit + multipliers_->on_goals[agent.goals[i]];
      reach.to_goals[i] = std::min(reach.to_goals[i], end);
    }
    const std::int64_t to_end = cost_to_end(agent, to_goals).first;
    if (to_end < kNoWalk) reach.least = std::min(reach.least, cost + to_end);
  };
  if (sets == 1) extend(0, agent.walks.start_to_goals);
  for (std::size_t stop = 0; stop < agent.conditions.size(); ++stop)
    if (to_stop(stop) < kNoWalk) extend(to_stop(stop), agent.walks.to_goals[stop]);
  return reach;
}

std::optional<RouteRelaxation::Reach> RouteRelaxation::find_reach(const AgentData& agent,
                                                                  const Limits& limits) {
  if (find_walks(agent, agent.walks.forward, limits) != NgWalks::Outcome::kFound)
    return std::nullopt;
  return reach_of(agent);
}

// The least costs of the labels of the reverse walks.
std::optional<std::vector<std::int64_t>> RouteRelaxation::costs_from_stops(const AgentData& agent,
                                                                           const Limits& limits) {
  std::vector<std::int64_t> to_end;
  for (const std::vector<Time>& to_goals : agent.walks.to_goals)
    to_end.push_back(cost_to_end(agent, to_goals).first);
  const NgStops reversed = agent.walks.reversed(*costs_, to_end);
  if (find_walks(agent, reversed, limits) != NgWalks::Outcome::kFound) return std::nullopt;
  return least_costs(agent);
}

// Calls use(agent, its Reach, costs_from_stops(), the greatest reduced cost of its walk in a plan
// below the cutoff). Returns false if the multipliers give no bound, or at a limit.
template <class Use>
bool RouteRelaxation::for_each_agent_below(const RouteMultipliers& multipliers, Cost cutoff,
                                           const Limits& limits, Use use) {
  multipliers_ = &multipliers;
  std::int64_t bound = constant();
  bool is_possible = true;  // does each agent have a walk?
  for (const AgentData& agent : agents_) {
    const auto reach = find_reach(agent, limits);
    if (!reach) return false;
    is_possible &= reach->least < kNoWalk;
    if (is_possible) bound += reach->least;
  }
  for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent) {
    const auto reach = find_reach(agents_[agent], limits);
    const auto after = costs_from_stops(agents_[agent], limits);
    if (!reach || !after) return false;
    std::int64_t most = kNoWalk - 1;
    if (!is_possible)
      most = -kNoWalk;
    else if (cutoff < kInfiniteCost)
      most = (cutoff - 1) * kUnit - (bound - reach->least);
    use(agent, *reach, *after, most);
  }
  return true;
}

// The choices of walks that cost at most `most`.
RouteChoices RouteRelaxation::choices_within(const AgentData& agent, const Reach& reach,
                                             const std::vector<std::int64_t>& after,
                                             std::int64_t most) const {
  const RouteChoices& left = choices_[agent.walks.agent];
  RouteChoices choices{.visits = {}, .required = left.required, .goals = {}};
  for (std::size_t i = 0; i < agent.goals.size(); ++i)
    if (reach.to_goals[i] <= most && std::ranges::count(left.goals, agent.walks.goals[i]) > 0)
      choices.goals.push_back(agent.walks.goals[i]);
  const std::size_t sets = std::size_t{1} << agent.walks.forward.remembered;
  for (const TaskIndex task : left.visits) {
    const auto stop = static_cast<std::size_t>(stop_of(agent.walks.agent, task));
    std::int64_t least = kNoWalk;
    for (std::size_t set = 0; set < sets; ++set)
      least =
          std::min(least, reach.to_stops[stop * sets + set] + after[(stop + 1) * sets - 1 - set]);
    if (least < kNoWalk && least + multipliers_->on_visits[agent.conditions[stop]] <= most)
      choices.visits.push_back(task);
  }
  return choices;
}

void RouteRelaxation::keep_legs_within(AgentData& agent, const Reach& reach,
                                       const std::vector<std::int64_t>& after, std::int64_t most) {
  const std::size_t sets = std::size_t{1} << agent.walks.forward.remembered;
  agent.walks.keep_legs(*costs_, [&](std::int32_t from, std::int32_t to, std::int64_t cost) {
    const std::int64_t* const ends = &after[static_cast<std::size_t>(to) * sets];
    if (from < 0) return cost + ends[sets - 1] <= most;
    const std::int64_t* const begins = &reach.to_stops[static_cast<std::size_t>(from) * sets];
    for (std::size_t set = 0; set < sets; ++set)
      if (begins[set] + cost + ends[sets - 1 - set] <= most) return true;
    return false;
  });
}

std::optional<std::vector<RouteChoices>> RouteRelaxation::choices_below(
    const RouteMultipliers& multipliers, Cost cutoff, const Limits& limits) {
  std::vector<RouteChoices> choices;
  const bool is_known =
      for_each_agent_below(multipliers, cutoff, limits,
                           [&](AgentIndex agent, const Reach& reach,
                               const std::vector<std::int64_t>& after, std::int64_t most) {
                             choices.push_back(choices_within(agents_[agent], reach, after, most));
                           });
  return is_known ? std::optional(std::move(choices)) : std::nullopt;
}

bool RouteRelaxation::fix(const RouteMultipliers& multipliers, Cost cutoff, const Limits& limits) {
  std::vector<RouteChoices> choices;
  std::vector<AgentData> reduced;
  const bool is_known =
      for_each_agent_below(multipliers, cutoff, limits,
                           [&](AgentIndex agent, const Reach& reach,
                               const std::vector<std::int64_t>& after, std::int64_t most) {
                             choices.push_back(choices_within(agents_[agent], reach, after, most));
                             reduced.push_back(agents_[agent]);
                             keep_legs_within(reduced.back(), reach, after, most);
                           });
  if (!is_known) return false;
  agents_ = std::move(reduced);
  restrict_to(choices);
  return true;
}

void RouteRelaxation::restrict_to(const std::vector<RouteChoices>& choices) {
  for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent) {
    const RouteChoices old = choices_[agent];
    for (const TaskIndex task : old.visits)
      if (!std::ranges::binary_search(choices[agent].visits, task)) set_excluded(agent, task);
    for (const TaskIndex task : choices[agent].required) set_required(agent, task);
    for (const Place goal : old.goals)
      if (std::ranges::count(choices[agent].goals, goal) == 0) set_excluded_goal(agent, goal);
  }
  decide_implied();
}

void RouteRelaxation::set_required(AgentIndex agent, TaskIndex task) {
  std::vector<TaskIndex>& required = choices_[agent].required;
  if (std::ranges::binary_search(required, task)) return;
  is_feasible_ &= std::ranges::binary_search(choices_[agent].visits, task);
  if (!is_feasible_) return;
  required.insert(std::ranges::upper_bound(required, task), task);
  agents_[agent].conditions[stop_of(agent, task)] = needs_.size();
  needs_.push_back(1);
  tasks_.push_back(task);
  --needs_[task];
}

void RouteRelaxation::set_excluded(AgentIndex agent, TaskIndex task) {
  is_feasible_ &= !std::ranges::binary_search(choices_[agent].required, task);
  std::erase(choices_[agent].visits, task);
  agents_[agent].walks.exclude(stop_of(agent, task));
}

void RouteRelaxation::set_excluded_goal(AgentIndex agent, Place goal) {
  std::erase(choices_[agent].goals, goal);
  agents_[agent].walks.exclude_goal(goal);
}

// Decides the choices that follow from needs and from goals that only one agent can use.
void RouteRelaxation::decide_implied() {
  for (TaskIndex task = 0; task < instance_->task_count(); ++task)
    if (!instance_->task(task).needs_all()) decide_implied(task);
  for (bool is_new = true; is_new && is_feasible_;) {
    is_new = false;
    for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent) {
      const std::vector<Place>& goals = choices_[agent].goals;
      if (const auto& own = instance_->agent(agent).goal)
        is_new |= exclude_from_others(agent, *own);
      else if (goals.size() == 1)
        is_new |= exclude_from_others(agent, goals.front());
      is_feasible_ &= instance_->agent(agent).goals.empty() || !goals.empty();
    }
  }
}

void RouteRelaxation::decide_implied(TaskIndex task) {
  std::vector<AgentIndex> undecided;
  for (const AgentIndex agent : instance_->task(task).agents)
    if (std::ranges::binary_search(choices_[agent].visits, task) &&
        !std::ranges::binary_search(choices_[agent].required, task))
      undecided.push_back(agent);
  const std::int64_t need = needs_[task];
  is_feasible_ &= need >= 0 && need <= std::ssize(undecided);
  if (!is_feasible_ || (need > 0 && need < std::ssize(undecided))) return;
  for (const AgentIndex agent : undecided)
    need > 0 ? set_required(agent, task) : set_excluded(agent, task);
}

// Returns true if another agent could have used the goal.
bool RouteRelaxation::exclude_from_others(AgentIndex user, Place goal) {
  bool is_new = false;
  for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent) {
    if (agent == user || std::ranges::count(choices_[agent].goals, goal) == 0) continue;
    set_excluded_goal(agent, goal);
    is_new = true;
  }
  return is_new;
}

std::size_t RouteRelaxation::bytes() const {
  std::size_t bytes = 0;
  for (const AgentData& agent : agents_) bytes += agent.walks.bytes();
  return bytes;
}

double RouteRelaxation::share(AgentIndex agent, TaskIndex task) const {
  return agents_[agent].shares[stop_of(agent, task)];
}

double RouteRelaxation::share_of_goal(AgentIndex agent, Place goal) const {
  const std::vector<Place>& goals = agents_[agent].walks.goals;
  return agents_[agent].shares_of_goals[std::ranges::find(goals, goal) - goals.begin()];
}

std::vector<TaskIndex> RouteRelaxation::neighborhood(AgentIndex agent, TaskIndex task) const {
  const AgentWalks& walks = agents_[agent].walks;
  std::vector<TaskIndex> tasks;
  for (const std::int32_t neighbor : walks.forward.stops[stop_of(agent, task)].neighbors)
    tasks.push_back(walks.tasks[neighbor]);
  return tasks;
}

}  // namespace grove::detail
