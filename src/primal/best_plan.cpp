// SPDX-License-Identifier: MIT
#include "primal/best_plan.h"

#include "model/assert.h"

namespace grove::detail {

void BestPlan::keep(const PlannedPaths& paths, PlanSource source) {
  GROVE_CHECK(paths.cost() < cost_, "a plan that replaces the best plan is cheaper");
  cost_ = paths.cost();
  source_ = source;
  paths_.resize(paths.paths().size());
  versions_.resize(paths_.size(), 0);
  Cost cost = 0;
  for (AgentIndex agent = 0; agent < std::ssize(paths_); ++agent) {
    if (versions_[agent] != paths.version(agent)) {
      versions_[agent] = paths.version(agent);
      paths_[agent] = paths.path(agent);
    }
    GROVE_ASSERT(paths_[agent] == paths.path(agent), "paths with equal versions are equal");
    cost += static_cast<Cost>(paths_[agent].size()) - 1;
  }
  GROVE_CHECK(cost == cost_, "the costs of the stored paths add up to the cost of the plan");
}

void BestPlan::adopt(Cost cost) {
  GROVE_CHECK(cost < cost_, "an adopted plan is cheaper than the best plan");
  cost_ = reported_cost_ = cost;
}

const std::vector<Path>& BestPlan::report(std::int64_t work) {
  GROVE_CHECK(is_unreported(), "each reported plan is cheaper than the one before");
  GROVE_CHECK(work >= work_at_report_, "effort never falls");
  reported_cost_ = cost_;
  work_at_report_ = work;
  return paths_;
}

}  // namespace grove::detail
