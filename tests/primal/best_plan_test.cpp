// SPDX-License-Identifier: MIT
#include "primal/best_plan.h"

#include <gtest/gtest.h>

#include "model/assert.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace best_plan_test {

// One agent in a corridor. `path` waits `waits` steps at its start.
struct Corridor {
  Path path(int waits) const {
    Path path(static_cast<std::size_t>(waits), instance.agent(0).start);
    for (State state = 0; state < 3; ++state) path.push_back(state);
    return path;
  }
  void put(int waits) {
    paths.clear();
    paths.put(0, path(waits));
  }

  const Instance instance = testing::instance_of({"..."}, {{{0, 0}, Position{2, 0}}});
  PlannedPaths paths{instance};
  BestPlan best;
};

TEST(BestPlan, ReportsEachBetterPlanOnce) {
  Corridor corridor;
  EXPECT_FALSE(corridor.best.exists());
  EXPECT_FALSE(corridor.best.is_unreported());
  for (const int waits : {4, 1}) {
    corridor.put(waits);
    corridor.best.keep(corridor.paths, PlanSource::kLns);
    EXPECT_EQ(corridor.best.cost(), 2 + waits);
    EXPECT_TRUE(corridor.best.is_unreported());
    EXPECT_EQ(corridor.best.report(100 - waits).at(0), corridor.path(waits));
    EXPECT_FALSE(corridor.best.is_unreported());
    EXPECT_EQ(corridor.best.work_since_report(110), 10 + waits);
  }
}

TEST(BestPlan, ReportsOnlyPlansBelowTheAdoptedOne) {
  Corridor corridor;
  corridor.put(4);
  corridor.best.keep(corridor.paths, PlanSource::kLacam);
  corridor.best.adopt(3);
  EXPECT_FALSE(corridor.best.is_unreported());
  corridor.put(0);
  corridor.best.keep(corridor.paths, PlanSource::kLns);
  EXPECT_EQ(corridor.best.source(), PlanSource::kLns);
  EXPECT_EQ(corridor.best.report(0).at(0), corridor.path(0));
}

TEST(BestPlan, RefusesPlansThatAreNotCheaper) {
  Corridor corridor;
  corridor.put(1);
  corridor.best.keep(corridor.paths, PlanSource::kLacam);
  EXPECT_THROW(corridor.best.keep(corridor.paths, PlanSource::kLacam), AssertionFailed);
  EXPECT_THROW(corridor.best.adopt(3), AssertionFailed);
  corridor.best.report(0);
  EXPECT_THROW(corridor.best.report(0), AssertionFailed);
}

}  // namespace best_plan_test
}  // namespace grove::detail
