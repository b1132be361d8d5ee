// SPDX-License-Identifier: MIT
// The primal side: valid plans, ever cheaper, from heuristics that prove nothing.
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

// Prioritised planning, raced by configuration search where it takes long (LaCAM; only with
// Technique::kConfigurations), then large neighbourhood search on the plan, from other seeds when
// that stalls (primal_search.cpp tells how). In small steps, so that one thread can do other things
// in between. The same seed, steps, adoptions and prices make the same plans, limits aside. For one
// thread.
class PrimalSearch {
 public:
  struct Counts {
    std::int64_t steps = 0;
    std::int64_t attempts = 0;       // of prioritised planning, failed ones included
    std::int64_t joint_steps = 0;    // of the configuration search
    std::int64_t neighborhoods = 0;  // destroyed and replanned
    std::int64_t low_level_calls = 0;
    std::int64_t low_level_expanded = 0;
  };

  // All must outlive this; `stops` may be shared with other searches of the same thread.
  PrimalSearch(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed,
               Techniques techniques = Techniques::defaults(), const Tuning& tuning = {});
  ~PrimalSearch();

  // Goes on for about a millisecond (or one call of the low level, where that is longer). Returns a
  // plan if it is cheaper than any returned or adopted before; source() then tells how it was
  // found. (Of large plans that become cheaper time after time not each.)
  std::optional<Plan> step(const Limits& limits);
  PlanSource source() const;

  // From now on looks for plans cheaper than `plan`, a valid one, beginning in its neighbourhood.
  // Ignored unless it is cheaper than all before.
  void adopt(const Plan& plan);

  // From now on knows what is dear where and when. Null, or the same as before: nothing new.
  // Not heeded while the best plan costs much more than those who made them have proven.
  void use(std::shared_ptr<const DualSolution> prices);

  // The cheapest plan returned or adopted, or about to be returned.
  std::optional<Cost> best_cost() const;
  // A plan is likely soon: the first, while the configuration search has neither given up nor begun
  // anew; or after its plan a much cheaper one, while prioritised planning has not taken long.
  // Never without the configuration search.
  bool expects_plan() const;
  // Every agent is on a path as short as if it were alone: there is nothing left to do.
  bool optimal() const;

  // Work done so far; see search/work.h.
  std::int64_t work() const;
  // The work after which the last plan was returned.
  std::int64_t work_at_last_plan() const;
  Counts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove::detail
