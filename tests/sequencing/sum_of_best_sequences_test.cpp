// SPDX-License-Identifier: MIT
#include "sequencing/sum_of_best_sequences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "model/distance_field.h"
#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail::testing {
namespace sum_of_best_sequences_test {

Time distance(const Instance& instance, Cell from, Cell to) {
  return distance_field(instance.grid(), to)[from];
}

// Returns the least cost over all orders of visits.
Time best_by_brute_force(const Instance& instance, const Agent& agent) {
  std::vector<std::size_t> order(agent.tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Time best = kNever;
  do {
    Time cost = 0;
    Cell at = agent.start;
    for (const std::size_t k : order) {
      const Cell next = instance.task(agent.tasks[k]).cell;
      cost += distance(instance, at, next);
      at = next;
    }
    if (agent.goal) cost += distance(instance, at, *agent.goal);
    best = std::min(best, cost);
  } while (std::ranges::next_permutation(order).found);
  return best;
}

const std::vector<std::string> kRooms{"........", "@.@@.@@.", "........", "...@....", "...@...."};

TEST(SumOfBestSequences, AgreesWithBruteForce) {
  const Instance instance =
      instance_of(kRooms, {{{0, 0}, Position{7, 4}, {{5, 0}, {0, 4}, {4, 3}, {2, 2}}},
                           {{7, 0}, std::nullopt, {{0, 4}, {6, 4}, {3, 0}}},
                           {{1, 2}, Position{2, 0}}});
  Cost expected = 0;
  for (const Agent& agent : instance.agents()) expected += best_by_brute_force(instance, agent);
  EXPECT_EQ(sum_of_best_sequences(instance, Limits()), expected);
}

TEST(SumOfBestSequences, IsInfiniteWithUnreachablePlaces) {
  EXPECT_EQ(sum_of_best_sequences(instance_of({"..@."}, {{{0, 0}, Position{3, 0}}}), Limits()),
            kInfiniteCost);
  EXPECT_EQ(sum_of_best_sequences(instance_of({"..@."}, {{{0, 0}, std::nullopt, {{1, 0}, {3, 0}}}}),
                                  Limits()),
            kInfiniteCost);
}

TEST(SumOfBestSequences, ReturnsNulloptWhenALimitIsReached) {
  Limits limits;
  limits.set_deadline(testing::kPast);
  EXPECT_EQ(
      sum_of_best_sequences(instance_of(kRooms, {{{0, 0}, Position{7, 4}, {{5, 0}}}}), limits),
      std::nullopt);
}

}  // namespace sum_of_best_sequences_test
}  // namespace grove::detail::testing
