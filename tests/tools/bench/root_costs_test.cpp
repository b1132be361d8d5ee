// SPDX-License-Identifier: MIT
#include "tools/bench/root_costs.h"

#include <gtest/gtest.h>

#include "tests/support/instances.h"

namespace grove::detail::bench {
namespace root_costs_test {

using grove::detail::testing::instance_of;

TEST(RootCosts, AreComputedOncePerInstance) {
  RootCosts costs(2, 60, 1'000'000'000'000);
  const Instance corridor = instance_of({"....."}, {{{0, 0}, Position{2, 0}, {{4, 0}}}});
  const Instance walled = instance_of({"..@."}, {{{0, 0}, Position{3, 0}}});
  EXPECT_EQ(costs.of(0, corridor), 6);
  EXPECT_EQ(costs.of(0, walled), 6);  // not computed again, because the index is the same
  EXPECT_EQ(costs.of(1, walled), std::nullopt);
}

TEST(RootCosts, AreMissingAtTheTimeLimit) {
  RootCosts costs(1, 0, 1'000'000'000'000);
  EXPECT_EQ(costs.of(0, instance_of({"..."}, {{{0, 0}, Position{2, 0}, {{1, 0}}}})), std::nullopt);
}

}  // namespace root_costs_test
}  // namespace grove::detail::bench
