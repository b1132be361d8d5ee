// SPDX-License-Identifier: MIT
// Tests the share of the primal search, according to the formulas at the head of
// engine/components/primal.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/components/primal.h"
#include "tests/primal/crowd.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace primal_share_test {

struct Setting {
  explicit Setting(Instance the_instance)
      : instance(std::move(the_instance)), primal(problem, stops, 1, Techniques()) {}

  Limits limits;
  Instance instance;
  Problem problem{instance, limits};
  AgentStopsCache stops{instance, problem.distances};
  PrimalSearch primal;
};

TEST(PrimalShare, FallsAfterManyFailuresWithoutAPlan) {
  // The agents cannot pass each other; the primal search does not detect this.
  Setting s(testing::instance_of({"......"}, {{{0, 0}, Position{5, 0}}, {{5, 0}, Position{0, 0}}}));
  EXPECT_EQ(wanted_primal_share(s.primal, 2, Tuning()), 8);
  for (int i = 0; i < 10'000 && s.primal.counts().attempts <= 4; ++i) s.primal.step(s.limits);
  ASSERT_GT(s.primal.counts().attempts, 4);
  Tuning tuning;
  EXPECT_EQ(wanted_primal_share(s.primal, 2, tuning), 1);
  tuning.primal_share_after_failures = 0.125;
  EXPECT_EQ(wanted_primal_share(s.primal, 2, tuning), 0.125);
}

TEST(PrimalShare, FollowsTheLastGain) {
  Setting s(testing::random_crowd({.size = 8, .obstacles = 10, .agents = 12, .tasks = 12}, 2));
  double min_x = 1;
  double max_x = 0;
  for (int i = 0; i < 400; ++i) {
    s.primal.step(s.limits);
    if (!s.primal.best_cost()) continue;
    ASSERT_FALSE(s.primal.optimal());
    const double x =
        static_cast<double>(s.primal.work_at_last_plan()) / static_cast<double>(s.primal.work());
    min_x = std::min(min_x, x);
    max_x = std::max(max_x, x);
    EXPECT_EQ(wanted_primal_share(s.primal, 12, Tuning()),
              std::clamp(8 * x * x * x, 1.0 / 32, 8.0));
  }
  EXPECT_LT(min_x, 0.2) << "the search must stall for this test";
  EXPECT_EQ(max_x, 1);
}

TEST(PrimalShare, CapGrowsFromAQuarterWithTheTreeWork) {
  const std::int64_t full = Tuning().primal_full_share_work;
  EXPECT_EQ(max_primal_share(2000, false, Tuning()), 0.25);
  EXPECT_EQ(max_primal_share(full / 32, false, Tuning()), 0.25);
  EXPECT_EQ(max_primal_share(full / 2, false, Tuning()), 4);
  EXPECT_EQ(max_primal_share(2 * full, false, Tuning()), 8);
  EXPECT_EQ(max_primal_share(2000, true, Tuning()), 8) << "while the gap is large";
}

}  // namespace primal_share_test
}  // namespace grove::detail
