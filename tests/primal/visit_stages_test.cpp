// SPDX-License-Identifier: MIT
#include "primal/visit_stages.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "primal/configurations.h"
#include "tests/fuzz/random.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace visit_stages_test {

using testing::instance_of;

TEST(VisitStages, DistancesFollowTheOrder) {
  const Instance instance = instance_of({"......"}, {{{1, 0}, Position{3, 0}, {{0, 0}, {5, 0}}}});
  const Problem problem(instance, Limits());
  VisitStages near_first(problem, 0, {0, 1});
  EXPECT_EQ(near_first.distance(near_first.first(), 1), 1 + 5 + 2);
  VisitStages far_first(problem, 0, {1, 0});
  EXPECT_EQ(far_first.distance(far_first.first(), 1), 4 + 5 + 3);
}

TEST(VisitStages, StopsPassedOnThePathAreVisited) {
  const Instance instance = instance_of({"......"}, {{{1, 0}, Position{3, 0}, {{0, 0}, {2, 0}}}});
  const Problem problem(instance, Limits());
  VisitStages visits(problem, 0, {0, 1});
  const auto first = visits.first();
  const auto second = visits.after(first, 2);
  EXPECT_NE(first, second);
  EXPECT_EQ(visits.distance(second, 2), 2 + 3);
  EXPECT_EQ(visits.after(second, 2), second);
  const auto done = visits.after(second, 0);
  EXPECT_EQ(done, visits.after(visits.after(first, 0), 2));
  EXPECT_FALSE(visits.may_rest(second, 3));
  EXPECT_TRUE(visits.may_rest(done, 3));
  EXPECT_FALSE(visits.may_rest(done, 0));
}

TEST(VisitStages, StopAtTheStartIsVisitedAtOnce) {
  const Instance instance = instance_of({"..."}, {{{1, 0}, {}, {{1, 0}, {2, 0}}}});
  const Problem problem(instance, Limits());
  VisitStages visits(problem, 0, {0, 1});
  EXPECT_EQ(visits.distance(visits.first(), 1), 1);
  const auto done = visits.after(visits.first(), 2);
  EXPECT_TRUE(visits.may_rest(done, 1) && visits.may_rest(done, 2));
  EXPECT_FALSE(visits.may_rest(done, 0));
}

TEST(VisitStages, DistanceToAnUnreachableStopIsNever) {
  const Instance instance =
      instance_of({"..@.@."}, {{{0, 0}, Position{1, 0}, {{3, 0}, {5, 0}, {1, 0}}}});
  const Problem problem(instance, Limits());
  for (const Sequence& order : {Sequence{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}) {
    VisitStages visits(problem, 0, order);
    EXPECT_GE(visits.distance(visits.first(), 0), kNever);
  }
}

TEST(Configurations, AreFoundByTheirPlaces) {
  constexpr int kAgents = 5;
  Configurations configurations(kAgents);
  fuzz::Random random(1);
  std::vector<std::vector<AgentState>> all;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<AgentState> places;
    for (int a = 0; a < kAgents; ++a) places.push_back({random.below(4), random.below(4)});
    const auto known = std::ranges::find(all, places) - all.begin();
    if (i % 10 != 0 && known == std::ssize(all)) continue;
    EXPECT_EQ(configurations.insert(places), known);
    if (known == std::ssize(all)) all.push_back(places);
  }
  EXPECT_EQ(configurations.count(), std::ssize(all));
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_TRUE(std::ranges::equal(configurations[static_cast<int>(i)], all[i]));
}

}  // namespace visit_stages_test
}  // namespace grove::detail
