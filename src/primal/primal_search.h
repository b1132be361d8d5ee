// SPDX-License-Identifier: MIT
// The primal search: heuristics that find valid plans of decreasing cost. They prove no bounds.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lagrangian/dual_solution.h"
#include "model/limits.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"
#include "primal/plan_source.h"
#include "search/techniques.h"

namespace grove::detail {

// Finds a first plan by prioritised planning, interleaved with LaCAM if planning takes long (only
// with Technique::kLacam, and if the instance permits following). Improves the plan by large
// neighbourhood search, an expensive plan first by traffic-guided LaCAM, and starts again with a
// different agent order when that stalls. The schedule is at the head of primal_search.cpp. Works
// in small steps, so that its thread can do other work in between. Deterministic: the same seed,
// steps, adopted plans and dual solutions yield the same plans, unless a limit is reached. One
// thread at a time.
class PrimalSearch {
 public:
  struct Counts {
    std::int64_t steps = 0;
    std::int64_t attempts = 0;       // orders started by prioritised planning
    std::int64_t joint_steps = 0;    // joint steps of LaCAM
    std::int64_t neighborhoods = 0;  // LNS iterations
    std::int64_t low_level_calls = 0;
    std::int64_t low_level_expanded = 0;
  };

  // `problem` and `stops` must outlive this object. `stops` can be shared with other searches on
  // the same thread.
  PrimalSearch(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed,
               Techniques techniques = Techniques::defaults(), const Tuning& tuning = {});
  ~PrimalSearch();

  // Continues for about a millisecond, or for one low-level call if that takes longer. Returns a
  // plan that is cheaper than all plans returned or adopted before, or nullopt; source() then says
  // how the plan was found. When large neighbourhood search improves a large plan in many small
  // steps, only some of the better plans are returned.
  std::optional<Plan> step(const Limits& limits);
  PlanSource source() const;

  // Makes the search continue from `plan`, which must be valid, for cheaper plans. Ignored unless
  // `plan` costs less than best_cost().
  void adopt(const Plan& plan);

  // Sets the dual solution that guides large neighbourhood search. Ignored if it is nullptr or the
  // current one, if there is no plan yet, or if the best plan costs more than (1 +
  // lagrangian_lns_max_gap) times the bound of the dual solution.
  void use(std::shared_ptr<const DualSolution> dual_solution);

  // Cost of the cheapest plan that was returned, adopted, or found and not yet returned. Returns
  // nullopt if there is no plan yet.
  std::optional<Cost> best_cost() const;
  // True if a plan, or a much cheaper plan, is likely to be found soon. Without a plan this is so
  // while LaCAM has not failed and has made fewer than kLacamExpectedSteps steps. With a plan it is
  // so while prioritised planning of the first round, or traffic-guided LaCAM, is in progress and
  // has spent less effort than the root of the tree takes (estimate: head of primal_search.cpp).
  // Always false without LaCAM, after LaCAM has failed, and if optimal().
  bool expects_plan() const;
  // True if the best plan is proven to be optimal, because each agent's path costs as little as the
  // agent's optimal path without the other agents.
  bool optimal() const;

  // Effort spent so far (unit: model/effort.h).
  std::int64_t work() const;
  // Value of work() at which the last better plan was found.
  std::int64_t work_at_last_plan() const;
  Counts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove::detail
