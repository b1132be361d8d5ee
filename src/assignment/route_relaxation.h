// SPDX-License-Identifier: MIT
// Lagrangian relaxation of the routes of all agents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assignment/agent_walks.h"
#include "assignment/route_choices.h"
#include "assignment/route_costs.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"
#include "sequencing/ng_walks.h"

namespace grove::detail {

// Multipliers in units of 1 / AgentWalks::kUnit steps, so that sums are exact.
struct RouteMultipliers {
  std::vector<std::int64_t> on_visits;  // by condition on visits; the first ones by TaskIndex
  std::vector<std::int64_t> on_goals;   // by position in RouteRelaxation::places()
};

// A lower bound on the cost of plans for given multipliers; the proof is at the head of
// route_relaxation.cpp. The choices can be reduced; the bound then holds for the plans whose routes
// make such choices. Copies are independent, but share memory for walks, so that only one of them
// may be used at a time.
class RouteRelaxation {
 public:
  // All choices. `costs` must outlive this object and its copies.
  explicit RouteRelaxation(const RouteCosts& costs);

  // True if the agents have too many legs in total. Nothing else may then be called.
  bool is_too_large() const { return agents_.empty(); }
  const std::vector<Place>& places() const { return places_; }  // the destinations of all agents
  // By condition on visits: the least number of visits, and the task.
  const std::vector<std::int64_t>& needs() const { return needs_; }
  const std::vector<TaskIndex>& tasks_of_conditions() const { return tasks_; }
  // The condition on the agent's visits to a task; nullopt: all walks meet it.
  std::optional<std::size_t> condition(AgentIndex agent, TaskIndex task) const;
  // In units of legs that are scanned, of all copies.
  std::int64_t effort() const { return walks_->effort(); }

  // Computes the bound. It may enlarge neighbourhoods, so a second call can have another result.
  NgWalks::Outcome evaluate(const RouteMultipliers& multipliers, std::int64_t max_effort,
                            const Limits& limits);
  // After kFound.
  std::int64_t bound() const { return bound_; }
  const std::vector<std::int64_t>& visits() const { return visits_; }  // by condition
  const std::vector<std::int64_t>& uses() const { return uses_; }      // by position in places()
  // After kNegativeCycle. If neighbourhoods have grown, the cycle is no longer possible.
  bool has_grown() const { return has_grown_; }
  const std::vector<std::size_t>& conditions_of_cycle() const { return conditions_of_cycle_; }

  // The choices that plans that cost less than `cutoff` can make (reduced cost fixing). Returns
  // nullopt if the multipliers give no bound, or a limit is reached.
  std::optional<std::vector<RouteChoices>> choices_below(const RouteMultipliers& multipliers,
                                                         Cost cutoff, const Limits& limits);
  // Leaves only these choices and the legs of such plans. From now on the bound holds for plans
  // that cost less than `cutoff`. Returns false where choices_below() returns nullopt.
  bool fix(const RouteMultipliers& multipliers, Cost cutoff, const Limits& limits);

  // Leaves only `choices`, by AgentIndex, and decides the choices that follow. Precondition: after
  // fix().
  void restrict_to(const std::vector<RouteChoices>& choices);
  // The choices that are left, by AgentIndex. is_feasible(): false if no plan makes them; choices()
  // then has no meaning.
  const std::vector<RouteChoices>& choices() const { return choices_; }
  bool is_feasible() const { return is_feasible_; }

  std::size_t bytes() const;  // of its largest parts

  // Exponentially weighted share of the evaluations in which the agent visits the task or ends on
  // the goal.
  double share(AgentIndex agent, TaskIndex task) const;
  double share_of_goal(AgentIndex agent, Place goal) const;

  // The neighbourhood of `task` in the walks of the agent, with `task` itself.
  std::vector<TaskIndex> neighborhood(AgentIndex agent, TaskIndex task) const;

 private:
  struct AgentData {
    AgentWalks walks;
    std::vector<std::size_t> conditions;  // by stop: index in needs_, or kExact
    std::vector<std::size_t> goals;       // by position in AgentWalks::goals: index in places_
    std::vector<double> shares;           // of recent evaluations, by stop
    std::vector<double> shares_of_goals;  // by position in AgentWalks::goals
  };
  static constexpr std::size_t kExact = std::numeric_limits<std::size_t>::max();
  // The least reduced costs of the walks of one agent.
  struct Reach {
    std::int64_t least = NgStops::kNoWalk;
    std::vector<std::int64_t> to_stops;  // see least_costs()
    std::vector<std::int64_t> to_goals;  // by position in AgentWalks::goals
  };

  void add_agent(AgentIndex agent);
  std::int64_t constant() const;
  NgWalks::Outcome find_walks(const AgentData& agent, const NgStops& stops, const Limits& limits,
                              std::int64_t max_effort = NgStops::kNoWalk);
  std::int64_t take_best_walk(AgentData& agent, NgWalks::LabelId* end_label);
  std::pair<std::int64_t, std::size_t> cost_to_end(const AgentData& agent,
                                                   const std::vector<Time>& to_goals) const;
  std::vector<std::int64_t> least_costs(const AgentData& agent) const;
  std::optional<Reach> find_reach(const AgentData& agent, const Limits& limits);
  Reach reach_of(const AgentData& agent) const;
  std::optional<std::vector<std::int64_t>> costs_from_stops(const AgentData& agent,
                                                            const Limits& limits);
  RouteChoices choices_within(const AgentData& agent, const Reach& reach,
                              const std::vector<std::int64_t>& after, std::int64_t most) const;
  void keep_legs_within(AgentData& agent, const Reach& reach,
                        const std::vector<std::int64_t>& after, std::int64_t most);
  template <class Use>
  bool for_each_agent_below(const RouteMultipliers& multipliers, Cost cutoff, const Limits& limits,
                            Use use);
  std::int32_t stop_of(AgentIndex agent, TaskIndex task) const;
  void set_required(AgentIndex agent, TaskIndex task);
  void set_excluded(AgentIndex agent, TaskIndex task);
  void set_excluded_goal(AgentIndex agent, Place goal);
  void decide_implied();
  void decide_implied(TaskIndex task);
  bool exclude_from_others(AgentIndex user, Place goal);

  const RouteCosts* costs_;
  const Instance* instance_;
  std::vector<Place> places_;
  std::vector<std::int64_t> needs_;
  std::vector<TaskIndex> tasks_;
  std::vector<AgentData> agents_;
  std::vector<RouteChoices> choices_;
  bool is_feasible_ = true;
  std::shared_ptr<NgWalks> walks_;
  const RouteMultipliers* multipliers_ = nullptr;  // of the current operation
  std::vector<std::int64_t> prizes_;               // of one agent, by stop
  std::int64_t bound_ = 0;
  std::vector<std::int64_t> visits_;
  std::vector<std::int64_t> uses_;
  std::vector<std::size_t> conditions_of_cycle_;
  bool has_grown_ = false;
};

}  // namespace grove::detail
