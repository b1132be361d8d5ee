// SPDX-License-Identifier: MIT
#include "planning/fewest_conflicts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "tests/planning/random_cases.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace fewest_conflicts_test {

// Returns the fewest conflicts of any path of the MDD that starts with `path` and continues at
// `node`, by enumeration.
int fewest(const Mdd& paths, const ConflictAvoidanceTable& others, Mdd::NodeId node, Path& path) {
  path.push_back(paths.state(node));
  int best = std::numeric_limits<int>::max();
  if (static_cast<Time>(path.size()) - 1 == paths.cost()) best = others.conflicts_of(path);
  for (const Mdd::NodeId next : paths.successors(node))
    best = std::min(best, fewest(paths, others, next, path));
  path.pop_back();
  return best;
}

void expect_fewest(const Instance& instance, std::initializer_list<Time> costs) {
  const Grid& grid = instance.grid();
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages goals(stops, {});
  MddBuilder builder(grid);
  FewestConflicts search;
  std::mt19937 random(11);
  int avoidable = 0;
  int waits = 0;
  for (const Time cost : costs) {
    Mdd paths;
    const auto outcome = builder.build(goals, {}, cost, 1'000'000, Limits(), paths);
    if (outcome != MddBuilder::Outcome::kBuilt) continue;
    for (int round = 0; round < 100; ++round) {
      ConflictAvoidanceTable others(grid);
      for (int i = 0; i < 2 + round / 10; ++i) others.add(testing::random_walk(grid, random, 9));
      Path path;
      search.find(paths, others, path);
      ASSERT_EQ(static_cast<Time>(path.size()) - 1, cost);
      Path so_far;
      const int least = fewest(paths, others, paths.layer(0).first, so_far);
      ASSERT_EQ(others.conflicts_of(path), least);
      avoidable += static_cast<int>(least == 0);
      waits += static_cast<int>(std::ranges::adjacent_find(path) != path.end());
    }
  }
  EXPECT_GT(avoidable, 0);
  EXPECT_GT(waits, 100);
}

TEST(FewestConflicts, FindsPathWithFewestConflicts) {
  expect_fewest(testing::instance_of({".....", "..@..", "....."},
                                     {{{0, 0}, Position{4, 2}, {{1, 1}, {3, 0}, {0, 2}}}}),
                {10, 11, 12, 13});
}

TEST(FewestConflicts, WaitsInPocketsOfACorridor) {
  expect_fewest(testing::instance_of({"@.@.@", ".....", "@.@.@"}, {{{0, 1}, Position{4, 1}, {}}}),
                {4, 5, 6, 7});
}

}  // namespace fewest_conflicts_test
}  // namespace grove::detail
