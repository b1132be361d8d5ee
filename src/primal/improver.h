// SPDX-License-Identifier: MIT
// Improver of the primal search, which shares the effort with the planner. Seeks a first plan by
// LaCAM and improves the current plan by traffic-guided LaCAM and large neighbourhood search (LNS).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "planning/planned_paths.h"
#include "planning/problem.h"
#include "primal/individual_costs.h"
#include "primal/lacam_with_restarts.h"
#include "primal/lns.h"
#include "primal/plan_source.h"
#include "primal/primal_low_level.h"
#include "primal/state_machine.h"
#include "primal/traffic_guided_lacam.h"

namespace grove::detail {

// One of the two state machines of the primal search; states and transitions: head of
// primal_search.cpp. One thread at a time.
class Improver {
 public:
  enum class State : std::uint8_t { kWaiting, kLacam, kGuided, kLns };
  // Steps and effort of LaCAM, with and without guidance.
  struct JointSearch {
    std::int64_t first_plan_steps = 0;  // joint steps of LaCAM for a first plan
    std::int64_t guided_steps = 0;      // joint steps of traffic-guided LaCAM
    std::int64_t guided_work = 0;       // effort of traffic-guided LaCAM, fields included
  };

  // `has_lacam`: LaCAM is possible. `individual` must be complete before step(), start_from() and
  // take_over() are called. All references must outlive this object.
  Improver(const Problem& problem, PrimalLowLevel& low_level, const IndividualCosts& individual,
           Random& random, std::uint64_t seed, bool has_lacam, const Tuning& tuning);

  State state() const { return states_.name(); }
  // True if step() may be called.
  bool is_active() const { return state() != State::kWaiting; }
  bool has_plan() const { return state() == State::kGuided || state() == State::kLns; }
  // False if LaCAM is not possible or has failed.
  bool has_lacam() const { return guidance() != Guidance::kImpossible; }

  // The current plan; empty without one. LNS can make it more expensive.
  const PlannedPaths& paths() const { return paths_; }
  // Source of the cheapest plan since the last call of start_from() or take_over().
  PlanSource source() const { return source_; }

  // Runs a slice of LaCAM or one LNS iteration. Requires is_active(). Returns true if the current
  // plan is new, or if LNS has made it cheaper than all plans since the last new one.
  bool step(const Limits& limits);
  // Makes `plan`, which must be valid, the current plan.
  void start_from(const Plan& plan, PlanSource source);
  // Makes the paths of prioritised planning the current plan, and removes them from `planned`.
  void take_over(PlannedPaths& planned);

  const JointSearch& joint_search() const { return joint_search_; }
  // Effort of LaCAM (unit: model/effort.h).
  std::int64_t joint_work() const {
    return joint_search_.first_plan_steps * agents() + joint_search_.guided_work;
  }
  std::int64_t lns_iterations() const { return lns_.steps(); }

 private:
  // Whether the search can still use traffic-guided LaCAM, which it does at most once. kImpossible:
  // LaCAM is not possible or has failed.
  enum class Guidance : std::uint8_t { kImpossible, kPossible, kUsed };

  struct Waiting {};
  struct FirstPlan {
    std::unique_ptr<LacamWithRestarts> lacam;  // nullptr before its first step
  };
  struct Guided {
    std::unique_ptr<TrafficGuidedLacam> lacam;
    int rounds_without_gain = 0;  // rounds without a cheaper plan
  };
  struct Lns {
    Guidance guidance;
  };
  static constexpr std::array<Transition<State>, 7> kTransitions{{
      {State::kWaiting, State::kLns},
      {State::kLacam, State::kWaiting},
      {State::kLacam, State::kGuided},
      {State::kLacam, State::kLns},
      {State::kGuided, State::kLns},
      {State::kLns, State::kGuided},
      {State::kLns, State::kLns},
  }};
  using States = StateMachine<State, Waiting, FirstPlan, Guided, Lns>;

  static States first_state(bool has_lacam);
  int agents() const { return problem_.instance.agent_count(); }
  Guidance guidance() const;
  bool should_guide(const Plan& plan) const;
  bool seek_first_plan(const Limits& limits);
  bool guide(const Limits& limits);
  bool improve(const Limits& limits);
  void put(const Plan& plan, PlanSource source);
  void begin_plan(PlanSource source);
  Guided guided_by(const Plan& plan);
  std::vector<Sequence> individual_orders() const;

  const Problem& problem_;
  PrimalLowLevel& low_level_;
  const IndividualCosts& individual_;
  Random& random_;
  const std::uint64_t seed_;
  const Tuning& tuning_;
  States states_;
  PlannedPaths paths_;
  PlanSource source_ = PlanSource::kPrioritizedPlanning;
  Cost least_cost_ = kInfiniteCost;  // of the plans since begin_plan()
  LargeNeighborhoodSearch lns_;
  JointSearch joint_search_;
};

}  // namespace grove::detail
