// SPDX-License-Identifier: MIT
// The primal search: heuristics that find valid plans of decreasing cost and prove nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lagrangian/dual_solution.h"
#include "model/limits.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "planning/agent_stops_cache.h"
#include "primal/plan_source.h"
#include "search/problem.h"
#include "search/techniques.h"

namespace grove::detail {

// Finds a first plan by prioritised planning, interleaved with LaCAM where that takes long (only
// with Technique::kLacam). Then it improves the plan by large neighbourhood search, and
// restarts with another agent order when that stalls. The schedule is at the head of
// primal_search.cpp. Works in small steps, so that one thread can do other work in between.
// Deterministic: the same seed, steps, adopted plans and dual solutions make the same plans, limits
// excepted. One thread at a time.
class PrimalSearch {
 public:
  struct Counts {
    std::int64_t steps = 0;
    std::int64_t attempts = 0;       // of prioritised planning, including failed ones
    std::int64_t joint_steps = 0;    // of LaCAM
    std::int64_t neighborhoods = 0;  // LNS iterations
    std::int64_t low_level_calls = 0;
    std::int64_t low_level_expanded = 0;
  };

  // All references must outlive this. `stops` may be shared with other searches of the same thread.
  PrimalSearch(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed,
               Techniques techniques = Techniques::defaults(), const Tuning& tuning = {});
  ~PrimalSearch();

  // Continues for about a millisecond, or for one low-level call if that takes longer. Returns a
  // plan if it is cheaper than all plans returned or adopted before; source() then specifies how it
  // was found. When large neighbourhood search improves a large plan in many small steps, only some
  // of the better plans are returned.
  std::optional<Plan> step(const Limits& limits);
  PlanSource source() const;

  // Searches from now on for plans cheaper than `plan`, which must be valid, and begins in its
  // neighbourhood. Ignored unless `plan` is cheaper than all plans before.
  void adopt(const Plan& plan);

  // Sets the dual solution that guides large neighbourhood search. Ignored if it is null, if it is
  // the current one, or if the best plan costs more than 1 + lagrangian_lns_max_gap times its
  // bound.
  void use(std::shared_ptr<const DualSolution> dual_solution);

  // Cost of the cheapest plan that was returned or adopted or is about to be returned. Returns
  // nullopt if there is none.
  std::optional<Cost> best_cost() const;
  // Whether a plan is likely soon. Without a plan: LaCAM has not failed and has made fewer than
  // kLacamExpectedSteps steps. With a plan, a much cheaper one is expected while prioritised
  // planning of the first round, or traffic-guided LaCAM, has done less work than the root of the
  // tree takes (estimate: head of primal_search.cpp). Always false without LaCAM.
  bool expects_plan() const;
  // Whether every agent has a path that is optimal without the other agents, so that the plan is
  // optimal.
  bool optimal() const;

  // Work done so far (unit: search/work.h).
  std::int64_t work() const;
  // Value of work() when the last better plan was found.
  std::int64_t work_at_last_plan() const;
  Counts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove::detail
