// SPDX-License-Identifier: MIT
#include "io/road_network.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace grove::detail {
namespace road_network_test {

RoadNetwork network(const std::vector<Link>& links) {
  return {"f", {{"A", {0, 0}}, {"B", {9, 0}}, {"C", {0, 9}}}, links};
}
Link link(double metres, std::optional<double> seconds = {}) {
  return {0, 1, true, metres, seconds, "line 7"};
}
Time steps(const Link& one, const StepScale& scale) {
  return in_steps(network({one}), scale).roads.at(0).steps;
}
constexpr StepScale kHalfMetres{.metres_per_step = 0.5};
constexpr StepScale kSeconds{.seconds_per_step = 2};
constexpr StepScale kBoth{.metres_per_step = 0.5, .seconds_per_step = 2};

TEST(RoadNetwork, StepsAreRoundedUpToOneAtLeast) {
  EXPECT_EQ(steps(link(3), kHalfMetres), 6);
  EXPECT_EQ(steps(link(3.01), kHalfMetres), 7);
  EXPECT_EQ(steps(link(3.49), kHalfMetres), 7);
  EXPECT_EQ(steps(link(0.5), kHalfMetres), 1);
  EXPECT_EQ(steps(link(1e-300), kHalfMetres), 1);
}

TEST(RoadNetwork, RoundingErrorsAddNoStep) {
  for (int whole = 1; whole <= 1000; ++whole)
    for (const double unit : {0.1, 0.3, 0.7, 1.1, 1.0 / 3})
      EXPECT_EQ(steps(link(whole * unit), {.metres_per_step = unit}), whole);
  EXPECT_EQ(steps(link(1.2), {.metres_per_step = 0.4}), 3);
  EXPECT_EQ(steps(link(1.2001), {.metres_per_step = 0.4}), 4);
}

TEST(RoadNetwork, LargerOfTimeAndLengthDecides) {
  EXPECT_EQ(steps(link(3, 7), kSeconds), 4);
  EXPECT_EQ(steps(link(3, 7), kHalfMetres), 6);
  EXPECT_EQ(steps(link(3, 7), kBoth), 6);
  EXPECT_EQ(steps(link(3, 17), kBoth), 9);
  EXPECT_EQ(steps(link(3), kBoth), 6);
  EXPECT_EQ(refusal([] { steps(link(3), kSeconds); }),
            "f: line 7: this edge has no time; expected a maximum speed (LIF), a duration "
            "(GraphML), or --metres-per-step for the speed of the robots");
}

TEST(RoadNetwork, LargestRoundingsAreReported) {
  const SteppedRoads roads = in_steps(network({link(50.05), link(0.6), link(2)}), kHalfMetres);
  EXPECT_EQ(roads.max_absolute.link, 0);  // 100.1 steps rounded up to 101
  EXPECT_NEAR(roads.max_absolute.exact, 100.1, 1e-9);
  EXPECT_EQ(roads.max_absolute.steps, 101);
  EXPECT_NEAR(roads.max_absolute.absolute(), 0.9, 1e-9);
  EXPECT_EQ(roads.max_relative.link, 1);  // 1.2 steps rounded up to 2
  EXPECT_NEAR(roads.max_relative.relative(), 0.8 / 1.2, 1e-9);
  EXPECT_EQ(in_steps(network({link(2), link(0.5)}), kHalfMetres).max_absolute.link, -1);
}

TEST(RoadNetwork, TooManyPlacesAreRefused) {
  EXPECT_EQ(refusal([] { steps(link(1e9), kHalfMetres); }),
            "f: line 7: this edge takes 2e+09 steps; expected at most 67108864; use longer steps");
  EXPECT_EQ(refusal([] { steps(link(1e308), {.metres_per_step = 1e-6}); }),
            "f: line 7: this edge takes inf steps; expected at most 67108864; use longer steps");
  EXPECT_EQ(refusal([] {
              in_steps(network({link(2e7), link(2e7)}), kHalfMetres);
            }),
            "f: line 7: the roads up to this one have more than 67108864 places; expected fewer; "
            "use longer steps");
}

TEST(RoadNetwork, LinkFromANodeToItselfIsRefused) {
  const Link loop{1, 1, true, 5, {}, "line 7"};
  EXPECT_EQ(refusal([&] {
              in_steps(network({link(1), loop}), kHalfMetres);
            }),
            "f: line 7: leads from a node to itself; expected two different nodes");
}

TEST(RoadNetwork, OppositeRoadsOfEqualLengthAreMerged) {
  const std::vector<Road> roads = {
      {0, 1, 3, true}, {1, 2, 4, true}, {1, 0, 2, true}, {1, 0, 3, true},  {2, 1, 5, true},
      {0, 2, 1, true}, {2, 0, 1, true}, {0, 1, 3, true}, {0, 1, 2, false},
  };
  const OppositeRoads count = opposite_roads(roads);
  EXPECT_EQ(count.alike, 2);   // 0 and 3, 5 and 6
  EXPECT_EQ(count.unlike, 2);  // 2 and 7, 1 and 4
  EXPECT_EQ(count.single_step, 1);
  const std::vector<Road> merged = with_merged_lanes(roads);
  ASSERT_EQ(merged.size(), 7u);
  EXPECT_EQ(merged[0].steps, 3);
  EXPECT_FALSE(merged[0].one_way);
  EXPECT_TRUE(merged[1].one_way);
  EXPECT_EQ(merged[2].steps, 2);  // road 3 was merged
  EXPECT_TRUE(merged[2].one_way);
  EXPECT_EQ(merged[3].from, 2);
  EXPECT_FALSE(merged[4].one_way);
  EXPECT_TRUE(merged[5].one_way);
  EXPECT_EQ(opposite_roads(merged).alike, 0);
}

}  // namespace road_network_test
}  // namespace grove::detail
