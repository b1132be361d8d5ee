// SPDX-License-Identifier: MIT
#include "engine/adaptations.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace adaptations_test {

Solution result(Status status, Cost lower_bound, Cost cost, const std::string& stopped_by) {
  Solution solution;
  solution.status = status;
  solution.lower_bound = lower_bound;
  solution.plan = Plan{.cost = cost, .agents = {}};
  if (!stopped_by.empty()) solution.stats.texts["stopped_by"] = stopped_by;
  return solution;
}

TEST(MergedResult, ReportsNoLimitIfBothResultsTogetherAreOptimal) {
  const Solution first = result(Status::kFeasible, 10, 12, "time limit");
  const Solution merged = merged_result(first, result(Status::kFeasible, 8, 10, "time limit"));
  EXPECT_EQ(merged.status, Status::kOptimal);
  EXPECT_EQ(merged.lower_bound, 10);
  EXPECT_FALSE(merged.stats.texts.contains("stopped_by"));
}

TEST(MergedResult, ReportsTheLimitOfTheSecondSearch) {
  const Solution first = result(Status::kFeasible, 9, 12, "time limit");
  const Solution merged = merged_result(first, result(Status::kFeasible, 8, 10, "memory limit"));
  EXPECT_EQ(merged.status, Status::kFeasible);
  EXPECT_EQ(merged.stats.texts.at("stopped_by"), "memory limit");
}

}  // namespace adaptations_test
}  // namespace grove::detail
