// SPDX-License-Identifier: MIT
// The best plan of the primal search, and the best plan that the caller has.
#pragma once

#include <cstdint>
#include <vector>

#include "model/limits.h"
#include "planning/planned_paths.h"
#include "primal/plan_source.h"

namespace grove::detail {

// The primal search finds the best plan or adopts it from the caller. Stores a plan that was found
// until the caller gets it. One thread at a time.
class BestPlan {
 public:
  // Cost of the best plan; kInfiniteCost if there is none yet.
  Cost cost() const { return cost_; }
  bool exists() const { return cost_ < kInfiniteCost; }
  // Source of the plan that was found last.
  PlanSource source() const { return source_; }

  // Stores the plan `paths`, which must be cheaper than the best plan.
  void keep(const PlannedPaths& paths, PlanSource source);
  // Records that the caller has a plan of this cost, less than cost().
  void adopt(Cost cost);

  // True if the best plan was found and the caller does not have it yet.
  bool is_unreported() const { return cost_ < reported_cost_; }
  // Effort since the last call of report(). `work`: the effort so far.
  std::int64_t work_since_report(std::int64_t work) const { return work - work_at_report_; }
  // Returns the paths of the best plan, by AgentIndex, and records that the caller gets the plan.
  const std::vector<Path>& report(std::int64_t work);

 private:
  Cost cost_ = kInfiniteCost;
  PlanSource source_ = PlanSource::kPrioritizedPlanning;
  std::vector<Path> paths_;             // by agent; empty until a plan is found
  std::vector<std::int64_t> versions_;  // by agent: PlannedPaths::version() of its path in paths_
  Cost reported_cost_ = kInfiniteCost;  // cost of the best plan that the caller has
  std::int64_t work_at_report_ = 0;
};

}  // namespace grove::detail
