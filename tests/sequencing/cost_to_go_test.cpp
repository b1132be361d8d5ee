// SPDX-License-Identifier: MIT
// Compares costs-to-go with all orders, or with the Held-Karp table if there are too many orders.
#include "sequencing/cost_to_go.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "sequencing/rtsp.h"
#include "tests/sequencing/matrices.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace cost_to_go_test {

using testing::fuzz_rounds;
using testing::kVariants;
using testing::Random;
using testing::Variant;

std::vector<int> members(StopSet set) {
  std::vector<int> stops;
  for (int stop = 0; stop < 64; ++stop)
    if (set >> stop & 1) stops.push_back(stop);
  return stops;
}

Time brute_force(const CostMatrix& matrix, StopSet left, int stop) {
  std::vector<int> order = members(left);
  std::int64_t best = kNever;
  do {
    std::int64_t cost = 0;
    int at = stop;
    for (int next : order) {
      cost += matrix.cost(at, next);
      at = next;
    }
    best = std::min(best, cost + matrix.cost(at, matrix.stops()));
  } while (std::next_permutation(order.begin(), order.end()));
  return static_cast<Time>(best);
}

void expect_exact(const CostMatrix& matrix) {
  CostToGo cost_to_go(matrix);
  ASSERT_TRUE(cost_to_go.extend(0, Limits()));
  EXPECT_EQ(cost_to_go.outside_bound(), kNever);
  for (StopSet left = 0; left <= matrix.all(); ++left)
    for (int stop : members(matrix.all() & ~left))
      ASSERT_EQ(cost_to_go.cost_to_go(left, stop), brute_force(matrix, left, stop));
}

TEST(CostToGo, RelaxedBoundEqualsThatOfTheMatrix) {
  Random random(5);
  for (const int n : {1, 6, 14, 15, 20}) {
    const CostMatrix matrix = testing::grid_matrix(n, Variant::kCts, random);
    CostToGo cost_to_go(matrix);
    const Time bound = relaxation_bound(matrix);
    EXPECT_EQ(cost_to_go.relaxed_bound(), bound);
    if (bound == kNever) continue;
    ASSERT_TRUE(cost_to_go.extend(bound + 3, Limits()));
    EXPECT_EQ(cost_to_go.relaxed_bound(), bound);
  }
}

TEST(CostToGo, IsExactAndCompleteForFewStops) {
  Random random(1);
  for (int round = fuzz_rounds(20); round > 0; --round)
    for (const Variant variant : kVariants)
      for (int n = 1; n <= 5; ++n) {
        expect_exact(testing::grid_matrix(n, variant, random));
        expect_exact(testing::wild_matrix(n, variant, random));
      }
}

TEST(CostToGo, LargeCostsDoNotOverflow) {
  Random random(2);
  CostMatrix matrix = testing::metric_matrix(5, Variant::kCts, random);
  testing::scale(matrix, 10'000);
  expect_exact(matrix);
}

TEST(CostToGo, IsEmptyBeforeWidening) {
  Random random(3);
  for (const int n : {4, 16}) {
    const CostMatrix matrix = testing::metric_matrix(n, Variant::kCts, random);
    const CostToGo cost_to_go(matrix);
    EXPECT_LT(cost_to_go.outside_bound(), kNever);
    EXPECT_EQ(cost_to_go.cost_to_go(matrix.all() & ~StopSet{1}, 0), kNever);
  }
}

// For 15 and 16 stops CostToGo uses the sequence graph; the reference is the Held-Karp table.
class GraphTest : public ::testing::Test {
 protected:
  // Expects the exact cost-to-go at the states of sequences that cost less than outside_bound().
  // Examines at most kMaxVisited states per test.
  void expect_exact_below_outside_bound(const CostMatrix& matrix, const CostToGo& cost_to_go) {
    const Limits limits;
    const auto table = make_rtsp_solver(RtspBackend::kHeldKarp, matrix, limits);
    SequenceClass work;
    walk(matrix, cost_to_go, *table, work, 0);
  }

 private:
  void walk(const CostMatrix& matrix, const CostToGo& cost_to_go, RtspSolver& table,
            SequenceClass& work, Time cost) {
    StopSet left = matrix.all();
    for (Stop stop : work.prefix) left &= ~(StopSet{1} << stop);
    const Time exact = table.best(work, kNever).cost;
    if (exact >= cost_to_go.outside_bound() || ++visited_ > kMaxVisited) return;
    if (!work.prefix.empty()) {
      ASSERT_EQ(cost + cost_to_go.cost_to_go(left, work.prefix.back()), exact);
    }
    const int at = work.prefix.empty() ? matrix.stops() : work.prefix.back();
    for (int stop : members(left)) {
      work.prefix.push_back(static_cast<Stop>(stop));
      walk(matrix, cost_to_go, table, work, cost + matrix.between(at, stop));
      work.prefix.pop_back();
    }
  }

  static constexpr int kMaxVisited = 2000;
  int visited_ = 0;
};

TEST_F(GraphTest, EverySequenceBelowTheBoundIsExact) {
  Random random(4);
  for (const Variant variant : kVariants) {
    const CostMatrix matrix = testing::grid_matrix(15, variant, random);
    CostToGo cost_to_go(matrix);
    for (int step = 0; step < 3 && cost_to_go.outside_bound() < kNever; ++step) {
      const Time cost_limit = cost_to_go.outside_bound();
      ASSERT_TRUE(cost_to_go.extend(cost_limit, Limits()));
      EXPECT_GT(cost_to_go.outside_bound(), cost_limit);
      expect_exact_below_outside_bound(matrix, cost_to_go);
    }
  }
}

TEST_F(GraphTest, WideningBelowTheBoundChangesNothing) {
  Random random(5);
  CostToGo cost_to_go(testing::metric_matrix(16, Variant::kCts, random));
  ASSERT_TRUE(cost_to_go.extend(cost_to_go.outside_bound(), Limits()));
  const Time outside_bound = cost_to_go.outside_bound();
  ASSERT_TRUE(cost_to_go.extend(outside_bound - 1, Limits()));
  EXPECT_EQ(cost_to_go.outside_bound(), outside_bound);
}

TEST(CostToGo, ReachedLimitChangesNothing) {
  Random random(6);
  for (const int n : {4, 16}) {
    CostToGo cost_to_go(testing::metric_matrix(n, Variant::kCts, random));
    const Time outside_bound = cost_to_go.outside_bound();
    Limits limits;
    limits.set_deadline(testing::kPast);
    EXPECT_FALSE(cost_to_go.extend(outside_bound, limits));
    EXPECT_EQ(cost_to_go.outside_bound(), outside_bound);
  }
}

}  // namespace cost_to_go_test
}  // namespace grove::detail
