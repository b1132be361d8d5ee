// SPDX-License-Identifier: MIT
#include "sequencing/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace grove::detail {
namespace assignment_test {

using Costs = std::vector<std::vector<std::int64_t>>;

std::optional<std::int64_t> best_by_enumeration(const Costs& cost) {
  std::vector<int> columns(cost.empty() ? 0 : cost.front().size());
  std::iota(columns.begin(), columns.end(), 0);
  std::optional<std::int64_t> best;
  do {
    std::int64_t total = 0;
    for (std::size_t row = 0; row < cost.size() && total < kForbidden; ++row)
      total = std::min(kForbidden, total + cost[row][columns[row]]);
    if (total < kForbidden && (!best || total < *best)) best = total;
  } while (std::ranges::next_permutation(columns).found);
  return best;
}

TEST(Assignment, AgreesWithEnumeration) {
  std::mt19937 random(3);
  int infeasible = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t rows = random() % 5;
    const std::size_t columns = rows + random() % 3;
    Costs cost(rows, std::vector<std::int64_t>(columns));
    for (auto& row : cost)
      for (auto& entry : row) entry = random() % 3 == 0 ? kForbidden : random() % 8;
    const auto assignment = min_cost_assignment(cost);
    const auto best = best_by_enumeration(cost);
    ASSERT_EQ(assignment.has_value(), best.has_value());
    if (!best) {
      ++infeasible;
      continue;
    }
    std::int64_t total = 0;
    for (std::size_t row = 0; row < rows; ++row) total += cost[row][assignment->columns[row]];
    EXPECT_EQ(total, *best);
    const std::set<int> used(assignment->columns.begin(), assignment->columns.end());
    EXPECT_EQ(used.size(), rows);
    for (std::size_t column = 0; column < assignment->prices.size(); ++column) {
      EXPECT_GE(assignment->prices[column], 0);
      if (!used.contains(static_cast<int>(column))) {
        EXPECT_EQ(assignment->prices[column], 0);
      }
    }
    for (std::size_t row = 0; row < rows; ++row) {
      const auto price_of = [&](std::size_t column) {
        return cost[row][column] + assignment->prices[column];
      };
      const auto own = static_cast<std::size_t>(assignment->columns[row]);
      for (std::size_t column = 0; column < columns; ++column)
        if (cost[row][column] < kForbidden) {
          EXPECT_LE(price_of(own), price_of(column));
        }
    }
  }
  EXPECT_GT(infeasible, 200);
}

}  // namespace assignment_test
}  // namespace grove::detail
