// SPDX-License-Identifier: MIT
// *Neighbourhoods.* Either strings of visits are removed from the routes of a few agents and
// inserted again (string_removal.h), or an agent gets another goal; the agent that has this goal
// gets the goal of the first agent. A few agents with a delay join them. The *delay* of an agent is
// the cost of its path minus the cost of its route. If the new routes cost more than the current
// paths of all these agents, they are rejected without planning, because a path costs no less than
// its route.
//
// *Repair.* These agents are planned one after the other, in random order, around the paths of all
// others. Each visits its stops in the order of its route (fixed_order_sipp.h). Among paths of
// equal cost, the search prefers those with few conflicts with the former paths of the agents that
// are still to be planned. The new paths are kept if they cost no more.
#include "assignment/exchange_search.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "assignment/assignment.h"
#include "assignment/string_removal.h"
#include "model/check.h"
#include "model/effort.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/fixed_order_sipp.h"
#include "planning/goal_sequence.h"
#include "planning/planned_paths.h"

namespace grove::detail {
namespace {

constexpr StringRemoval::Size kStrings{.longest = 4, .mean = 2};
constexpr int kGoalsDrawn = 4;               // of which the nearest is chosen
constexpr int kMaxDelayed = 3;               // delayed agents that join, at most
constexpr int kDelayedDrawn = 4;             // of which the one with the greatest delay is chosen
constexpr std::int64_t kMaxLabels = 20'000;  // of a call of the low level
constexpr std::int64_t kInsertions = 6;      // into a route, that count as one unit of effort

}  // namespace

class ExchangeSearch::Search {
 public:
  Search(const Instance& instance, const DistanceFields& distances, const Routes& routes,
         std::uint64_t seed)
      : instance_(instance),
        distances_(distances),
        random_(seed),
        routes_(routes.costs()),
        paths_(instance),
        former_(instance.world()),
        low_level_(instance.world()),
        strings_(routes_, random_, kStrings) {
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      if (instance.agent(agent).goals.size() > 1) choosers_.push_back(agent);
  }

  void start_from(const Plan& plan) {
    paths_.clear();
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      const AgentPlan& of = plan.agents[agent];
      routes_.set_stops(agent, stops_of(agent, of));
      if (!instance_.agent(agent).goals.empty())
        routes_.set_goal(agent, instance_.world().place(of.path.back()));
      paths_.put(agent, walked_path(instance_, agent, of));
    }
    strings_.begin();
    checked_cost_ = kInfiniteCost;
  }

  std::optional<Plan> improve(Cost cost, std::int64_t max_effort, const Limits& limits) {
    const std::int64_t end = effort() + max_effort;
    while (effort() < end && !limits.stop_requested()) {
      ++iterations_;
      step(limits);
      if (paths_.cost() >= std::min(cost, checked_cost_)) continue;
      checked_cost_ = paths_.cost();
      Plan found = plan();
      if (found.cost < cost) return found;
    }
    return std::nullopt;
  }

 private:
  struct OldGoal {
    AgentIndex agent;
    Place goal;
  };

  // An agent that starts at work completes its task first.
  std::vector<TaskIndex> stops_of(AgentIndex agent, const AgentPlan& plan) const {
    std::vector<TaskIndex> stops = plan.sequence;
    if (const auto begun = task_at_start(instance_, agent)) {
      std::erase(stops, *begun);
      stops.insert(stops.begin(), *begun);
    }
    return stops;
  }

  std::int64_t effort() const {
    return low_level_.expanded() + effort::kUnitsPerCall * (calls_ + iterations_) +
           paths_.steps_moved() / effort::kMovedSteps + strings_.insertions() / kInsertions;
  }

  void step(const Limits& limits) {
    old_goals_.clear();
    agents_.clear();
    const bool changes_goals =
        !choosers_.empty() && (!strings_.is_possible() || random_.below(4) == 0);
    if (changes_goals ? !change_goals() : !change_visits()) return;
    add_delayed();
    if (!replan(limits)) undo(changes_goals);
  }

  bool change_visits() {
    if (!strings_.is_possible()) return true;
    if (!strings_.apply()) return false;
    for (const StringRemoval::Saved& saved : strings_.changed()) agents_.push_back(saved.agent);
    return true;
  }

  // An agent gets a goal near the end of its route. If another agent has this goal, the two
  // exchange their goals.
  bool change_goals() {
    const AgentIndex agent = choosers_[random_.below(choosers_.size())];
    const std::vector<Place>& goals = instance_.agent(agent).goals;
    const Place old = *routes_.goal(agent);
    Place next = old;
    for (int i = 0; i < kGoalsDrawn; ++i) {
      const Place goal = goals[random_.below(goals.size())];
      if (goal != old &&
          (next == old || routes_.leg_to_goal(agent, goal) < routes_.leg_to_goal(agent, next)))
        next = goal;
    }
    if (next == old || routes_.leg_to_goal(agent, next) >= kNever) return false;
    for (AgentIndex other = 0; other < instance_.agent_count(); ++other) {
      if (routes_.goal(other) != next) continue;
      if (std::ranges::count(instance_.agent(other).goals, old) == 0) return false;
      set_goal(other, old);
    }
    set_goal(agent, next);
    return true;
  }
  void set_goal(AgentIndex agent, Place goal) {
    old_goals_.push_back({agent, *routes_.goal(agent)});
    routes_.set_goal(agent, goal);
    agents_.push_back(agent);
  }

  void undo(bool changes_goals) {
    for (const OldGoal& old : old_goals_) routes_.set_goal(old.agent, old.goal);
    if (!changes_goals && strings_.is_possible()) strings_.undo();
  }

  Cost delay(AgentIndex agent) const { return paths_.cost(agent) - routes_.cost(agent); }

  void add_delayed() {
    for (int more = random_.below(kMaxDelayed + 1); more > 0; --more) {
      AgentIndex most = random_.below(instance_.agent_count());
      for (int i = 1; i < kDelayedDrawn; ++i) {
        const AgentIndex other = random_.below(instance_.agent_count());
        if (delay(other) > delay(most)) most = other;
      }
      if (std::ranges::count(agents_, most) == 0) agents_.push_back(most);
    }
  }

  // Plans the chosen agents again. Returns false if the old paths are kept.
  bool replan(const Limits& limits) {
    Cost left = 0;  // for the paths that are not planned, beyond the costs of their routes
    for (const AgentIndex agent : agents_) left += delay(agent);
    if (left < 0) return false;
    random_.shuffle(agents_);
    old_paths_.clear();
    former_.clear();
    for (const AgentIndex agent : agents_) {
      old_paths_.push_back(paths_.take(agent));
      former_.add(old_paths_.back());
    }
    for (std::size_t i = 0; i < agents_.size(); ++i) {
      former_.remove(old_paths_[i]);
      const Cost least = routes_.cost(agents_[i]);
      if (!find(agents_[i], least + left, limits)) {
        restore();
        return false;
      }
      left -= paths_.cost(agents_[i]) - least;
    }
    return true;
  }

  bool find(AgentIndex agent, Cost cutoff, const Limits& limits) {
    const std::optional<PlaceOfRest> rest = rest_of(agent);
    const std::vector<TaskIndex>& stops = routes_.stops(agent);
    if (stops.empty() && !rest) return false;
    ++calls_;
    const PathQuery query{.others = &former_,
                          .cutoff = static_cast<Time>(cutoff),
                          .label_limit = kMaxLabels,
                          .reservations = &paths_.reservations()};
    const GoalSequence goals(instance_, distances_, agent, stops, rest);
    if (low_level_.find(goals, query, limits, path_) != PathOutcome::kFound) return false;
    if (ends_within_turn(agent)) return false;
    paths_.put(agent, std::move(path_));
    path_.clear();
    return true;
  }

  // Such a path of an idle agent is not complete if the agent may visit tasks.
  bool ends_within_turn(AgentIndex agent) const {
    const Agent& who = instance_.agent(agent);
    const State last = instance_.world().base(path_.back());
    return who.is_idle() && !who.options.empty() && instance_.pose_of(last).steps > 0;
  }

  // An idle agent rests anywhere. Another agent without a destination rests on its last stop.
  std::optional<PlaceOfRest> rest_of(AgentIndex agent) const {
    const Agent& who = instance_.agent(agent);
    if (const auto goal = routes_.goal(agent))
      return PlaceOfRest{*goal, routes_.costs().distances_to_goal(agent, *goal)};
    if (who.is_idle() || (who.options.empty() && !instance_.rests_on_last_stop(agent)))
      return PlaceOfRest{kNoPlace, distances_.to_rest(agent)};
    return std::nullopt;
  }

  void restore() {
    for (const AgentIndex agent : agents_)
      if (!paths_.path(agent).empty()) paths_.take(agent);
    for (std::size_t i = 0; i < agents_.size(); ++i)
      paths_.put(agents_[i], std::move(old_paths_[i]));
  }

  Plan plan() const {
    Plan plan;
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      const Path& path = paths_.path(agent);
      plan.agents.push_back(
          instance_.agent(agent).options.empty()
              ? plan_of_path(instance_, agent, path)
              : agent_plan_of_visits(instance_, agent, routes_.stops(agent), path));
      plan.cost += plan.agents.back().cost;
    }
    return checked_plan(instance_, with_stated_visits(instance_, std::move(plan)));
  }

  const Instance& instance_;
  const DistanceFields& distances_;
  Random random_;
  Routes routes_;
  PlannedPaths paths_;
  ConflictAvoidanceTable former_;  // old paths of the agents without a path
  FixedOrderSipp low_level_;
  StringRemoval strings_;
  std::vector<AgentIndex> choosers_;   // agents that can change their goal
  Cost checked_cost_ = kInfiniteCost;  // of the cheapest paths of which a plan was made
  // Of the current iteration.
  std::vector<AgentIndex> agents_;
  std::vector<OldGoal> old_goals_;
  std::vector<Path> old_paths_;
  Path path_;
  std::int64_t calls_ = 0;
  std::int64_t iterations_ = 0;
};

ExchangeSearch::ExchangeSearch(const Instance& instance, const DistanceFields& distances,
                               const Routes& routes, std::uint64_t seed)
    : search_(std::make_unique<Search>(instance, distances, routes, seed)) {}
ExchangeSearch::~ExchangeSearch() = default;

void ExchangeSearch::start_from(const Plan& plan) {
  search_->start_from(plan);
}

std::optional<Plan> ExchangeSearch::improve(Cost cost, std::int64_t max_effort,
                                            const Limits& limits) {
  return search_->improve(cost, max_effort, limits);
}

}  // namespace grove::detail
