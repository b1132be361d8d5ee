// SPDX-License-Identifier: MIT
// Planner of the primal search: plans the agents one by one, first individually and then in rounds
// of prioritised planning.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "planning/planned_paths.h"
#include "planning/problem.h"
#include "primal/individual_costs.h"
#include "primal/primal_low_level.h"
#include "primal/prioritized_planning.h"
#include "primal/state_machine.h"

namespace grove::detail {

// One of the two state machines of the primal search; states and transitions: head of
// primal_search.cpp. One thread at a time.
class Planner {
 public:
  enum class State : std::uint8_t { kIndividual, kFirstRound, kIdle, kLaterRound };

  // All references must outlive this object.
  Planner(const Problem& problem, PrimalLowLevel& low_level, Random& random, const Tuning& tuning);

  State state() const { return states_.name(); }
  // True if prioritised planning is in progress.
  bool is_planning() const {
    return state() == State::kFirstRound || state() == State::kLaterRound;
  }
  const IndividualCosts& individual_costs() const { return individual_; }
  // True if every agent has an individual path.
  bool knows_individual_costs() const { return state() != State::kIndividual; }

  // State kIndividual: plans the next agent. Returns true if all agents have individual paths, or
  // false if agents are left or a limit was reached.
  bool plan_individually(const Limits& limits);
  // State kIndividual: stores the plan that the search adopted last, until begin_first_round().
  void keep_adopted(const Plan& plan);

  // State kIndividual, after the last agent: begins the first round. Returns the adopted plan, if
  // there is one.
  std::optional<Plan> begin_first_round();
  // State kIdle: begins a later round.
  void begin_later_round();
  // In a round: runs one step of prioritised planning. `has_rival`: LaCAM or LNS can use part of
  // the effort, so long low-level calls are postponed. Returns true if all agents have paths.
  bool plan(const Limits& limits, bool has_rival);
  // In a round: ends it. Returns the paths of prioritised planning, which the caller must remove.
  // They are those of all agents if plan() has returned true.
  PlannedPaths& end_round();

  // In a round: the effort of prioritised planning, and that of other heuristics, in this round.
  std::int64_t planning_work() const { return round().planning_work; }
  std::int64_t other_work() const { return round().other_work; }
  void add_planning_work(std::int64_t work);
  void add_other_work(std::int64_t work);

  // Number of orders started by prioritised planning.
  std::int64_t attempts() const { return planning_.attempts(); }
  // Number of failures of prioritised planning since the round began.
  std::int64_t failures() const { return planning_.failures(); }
  // See PlannedPaths::steps_moved().
  std::int64_t steps_moved() const { return paths_.steps_moved(); }

 private:
  struct Individual {
    AgentIndex next = 0;          // this agent and later ones have no individual path yet
    std::optional<Plan> adopted;  // the first round begins with it
  };
  struct Round {
    std::int64_t label_limit;  // label limit of a low-level call if there is a rival
    std::int64_t planning_work = 0;
    std::int64_t other_work = 0;
  };
  struct FirstRound : Round {};
  struct Idle {};
  struct LaterRound : Round {};
  static constexpr std::array<Transition<State>, 4> kTransitions{{
      {State::kIndividual, State::kFirstRound},
      {State::kFirstRound, State::kIdle},
      {State::kIdle, State::kLaterRound},
      {State::kLaterRound, State::kIdle},
  }};

  const Round& round() const {
    if (state() == State::kFirstRound) return states_.as<FirstRound>();
    return states_.as<LaterRound>();
  }
  Round& round() {
    if (state() == State::kFirstRound) return states_.as<FirstRound>();
    return states_.as<LaterRound>();
  }
  Round new_round() const { return {tuning_.pp_head_start * individual_.work}; }
  std::vector<AgentIndex> agents_by_cost(double noise);

  const int agents_;
  PrimalLowLevel& low_level_;
  Random& random_;
  const Tuning& tuning_;
  StateMachine<State, Individual, FirstRound, Idle, LaterRound> states_;
  IndividualCosts individual_;
  PlannedPaths paths_;  // of prioritised planning; empty outside a round
  PrioritizedPlanning planning_;
};

}  // namespace grove::detail
