// SPDX-License-Identifier: MIT
#include "primal/traffic.h"

#include <gtest/gtest.h>

#include "tests/fuzz/random_instance.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace traffic_test {

using testing::instance_of;

// A map with two routes of equal length from cell 5 to cell 9, above and below a wall, and the
// traffic on it.
struct Block {
  Block() { traffic.update_edge_costs(); }
  DistanceField field(Place to) {
    const DistanceField steps = distance_field(world, to);
    return traffic.field(DistanceView(steps));
  }
  void walk(const Path& path) {
    traffic.add(path, 1);
    traffic.update_edge_costs();
  }

  const Instance instance = instance_of({".....", ".@@@.", "....."}, {{{0, 1}, Position{4, 1}}});
  const World& world = instance.world();
  const Tuning tuning;
  Traffic traffic{world, 4, tuning};
  const Path above{5, 0, 1, 2, 3, 4, 9};
};

// Compares the distances to all tasks of random tiny instances with eight times their steps.
TEST(Traffic, StepsCostEightWithoutTraffic) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Instance instance = fuzz::random_instance(seed).build();
    const World& world = instance.world();
    const Tuning tuning;
    Traffic traffic(world, 3, tuning);
    traffic.update_edge_costs();
    const DistanceFields distances(instance);
    for (TaskIndex task = 0; task < instance.task_count(); ++task) {
      const DistanceView steps = distances.to_task(task);
      const DistanceField field = traffic.field(steps);
      for (State state = 0; state < world.state_count(); ++state) {
        ASSERT_EQ(field[state] == kNever, steps[state] == kNever);
        if (steps[state] < kNever) {
          ASSERT_EQ(field[state] % 8, 0);
          ASSERT_EQ(field[state] / 8, steps[state]);
        }
      }
    }
  }
}

TEST(Traffic, MakesTheOtherPathCheaper) {
  Block block;
  const DistanceField before = block.field(9);
  EXPECT_EQ(before[0], before[10]);
  block.walk(block.above);
  const DistanceField after = block.field(9);
  EXPECT_GT(after[0], before[0]);
  EXPECT_LT(after[10], after[0]);
}

TEST(Traffic, CostsMoreAgainstTheFlow) {
  Block block;
  block.walk(block.above);
  EXPECT_GT(block.field(1)[3], block.field(3)[1]);
}

TEST(Traffic, CountsWaits) {
  Block block;
  block.walk({5, 0, 0, 0, 0, 1, 2, 3, 4, 9});
  EXPECT_GT(block.field(1)[5], block.field(3)[1]);
}

TEST(Traffic, FadesToNothingWithFactorZero) {
  Block block;
  const DistanceField before = block.field(9);
  block.walk(block.above);
  block.traffic.fade(0);
  block.traffic.update_edge_costs();
  EXPECT_EQ(block.field(9), before);
}

// The edge cost is capped, because the bucket queue cannot hold larger costs.
TEST(Traffic, EdgeCostIsCapped) {
  Block block;
  for (int i = 0; i < 10'000; ++i) block.traffic.add(block.above, 1);
  block.traffic.update_edge_costs();
  const DistanceField field = block.field(5);
  for (State state = 0; state < block.world.state_count(); ++state)
    EXPECT_EQ(field[state] < kNever, !block.world.moves(state).empty());
}

}  // namespace traffic_test
}  // namespace grove::detail
