// SPDX-License-Identifier: MIT
#include "search/covering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace grove::detail {
namespace covering_test {

// Returns the least sum that satisfies all statements, by enumerating all assignments of 0 to
// `max_given` to each agent.
Cost brute_force(const std::vector<GroupExcess>& statements, int agents, int max_given) {
  std::vector<int> given(static_cast<std::size_t>(agents));
  Cost best = kInfiniteCost;
  for (;;) {
    Cost sum = 0;
    for (int g : given) sum += g;
    const bool fulfilled = std::ranges::all_of(statements, [&](const GroupExcess& s) {
      Cost have = 0;
      for (AgentIndex a : s.agents) have += given[a];
      return have >= s.excess;
    });
    if (fulfilled) best = std::min(best, sum);
    int i = 0;
    while (i < agents && given[i] == max_given) given[i++] = 0;
    if (i == agents) return best;
    ++given[i];
  }
}

std::vector<GroupExcess> random_statements(std::mt19937& random, int agents) {
  std::vector<GroupExcess> statements(random() % 8);
  for (GroupExcess& s : statements) {
    const int size = 2 + static_cast<int>(random() % 2);
    while (static_cast<int>(s.agents.size()) < size) {
      const auto agent = static_cast<AgentIndex>(random() % agents);
      if (std::ranges::count(s.agents, agent) == 0) s.agents.push_back(agent);
    }
    s.excess = 1 + static_cast<Cost>(random() % 3);
  }
  return statements;
}

TEST(CoveringBound, EqualsTheLeastSumOfABruteForce) {
  std::mt19937 random(5);
  for (int round = 0; round < 1500; ++round) {
    const int agents = 3 + static_cast<int>(random() % 4);
    const auto statements = random_statements(random, agents);
    EXPECT_EQ(covering_bound(statements), brute_force(statements, agents, 3));
  }
}

TEST(CoveringBound, StaysALowerBoundAtItsStepLimit) {
  std::mt19937 random(6);
  int below = 0;
  for (int round = 0; round < 1500; ++round) {
    const auto statements = random_statements(random, 5);
    const Cost bound = covering_bound(statements, 1 + static_cast<std::int64_t>(random() % 6));
    const Cost least = brute_force(statements, 5, 3);
    EXPECT_LE(bound, least);
    below += static_cast<int>(bound < least);
  }
  EXPECT_GT(below, 0);
}

TEST(CoveringBound, IsZeroWithoutStatements) {
  EXPECT_EQ(covering_bound({}), 0);
}

// Before any plan gives a finite limit, pairs without collision-free paths have excesses near
// infinity. The recursion must not be as deep as these numbers, and their sums must not overflow.
TEST(CoveringBound, HandlesStatementsOfInfiniteCost) {
  std::vector<GroupExcess> statements;
  for (AgentIndex a = 0; a < 20; a += 2) {
    statements.push_back({{a, a + 1}, kInfiniteCost - 100});
    EXPECT_GE(covering_bound(statements), kInfiniteCost - 100);
    EXPECT_LE(covering_bound(statements), kInfiniteCost);
  }
}

TEST(CoveringBound, StaysALowerBoundForLargeSums) {
  const std::vector<GroupExcess> triangle{{{0, 1}, 30'000}, {{1, 2}, 30'000}, {{0, 2}, 30'000}};
  EXPECT_GE(covering_bound(triangle), 30'000);
  EXPECT_LE(covering_bound(triangle), 45'000);
}

}  // namespace covering_test
}  // namespace grove::detail
