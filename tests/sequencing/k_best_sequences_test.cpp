// SPDX-License-Identifier: MIT
#include "sequencing/k_best_sequences.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "brute_force.h"
#include "matrices.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::testing {
namespace k_best_sequences_test {

KBestSequences list_of(const CostMatrix& matrix, RtspBackend backend, const Limits& limits) {
  return {make_rtsp_solver(backend, matrix, limits), matrix, limits};
}

// Returns the costs of the first `count` sequences. Checks all guarantees of KBestSequences.
std::vector<Time> first_costs(const CostMatrix& matrix, RtspBackend backend, std::size_t count) {
  const Limits limits;
  KBestSequences list = list_of(matrix, backend, limits);
  std::vector<Time> costs;
  std::set<std::vector<int>> seen;  // as int: GCC 12 warns of comparisons of bytes
  for (std::size_t rank = 0; rank < count; ++rank) {
    const Time bound = list.cost_bound(rank);
    const Time cost = list.resolve(rank, kNever);
    EXPECT_LE(bound, cost);
    if (!costs.empty()) {
      EXPECT_LE(costs.back(), bound);
    }
    if (!list.known(rank)) {
      EXPECT_EQ(cost, kNever);
      break;
    }
    const Sequence& sequence = list.sequence(rank);
    EXPECT_TRUE(is_complete(matrix, sequence));
    EXPECT_EQ(sequence_cost(matrix, sequence), cost);
    EXPECT_TRUE(seen.emplace(sequence.begin(), sequence.end()).second) << "a sequence twice";
    costs.push_back(cost);
  }
  return costs;
}

std::vector<Time> brute_costs(const CostMatrix& matrix, std::size_t count) {
  std::vector<Time> costs = all_costs(matrix, {});
  if (costs.size() > count) costs.resize(count);
  return costs;
}

class KBestTest : public ::testing::TestWithParam<RtspBackend> {};

std::string name_of(const ::testing::TestParamInfo<RtspBackend>& info) {
  const char* names[] = {"Auto", "HeldKarp", "BoundedDp", "Cbc"};
  return names[static_cast<int>(info.param)];
}

// Lists for up to 5 stops are enumerated completely.
TEST_P(KBestTest, FirstTwoHundredAgreeWithPermutations) {
  Random random(11);
  for (int round = 0; round < fuzz_rounds(GetParam() == RtspBackend::kCbc ? 1 : 4); ++round)
    for (Variant variant : kVariants)
      for (int n = variant == Variant::kCts ? 0 : 1; n <= 7; ++n) {
        if (GetParam() == RtspBackend::kCbc && n > 6) continue;
        CostMatrix matrix = grid_matrix(n, variant, random);
        ASSERT_EQ(first_costs(matrix, GetParam(), 200), brute_costs(matrix, 200));
        if (n == 0) continue;
        matrix = metric_matrix(n, variant, random);
        ASSERT_EQ(first_costs(matrix, GetParam(), 200), brute_costs(matrix, 200));
        if (n > 5) continue;
        matrix = wild_matrix(n, variant, random);
        ASSERT_EQ(first_costs(matrix, GetParam(), 200), brute_costs(matrix, 200));
      }
}

TEST_P(KBestTest, ListsTheFirst200OfEightStops) {
  Random random(12);
  for (Variant variant : kVariants) {
    const CostMatrix matrix = grid_matrix(8, variant, random);
    const std::size_t count = GetParam() == RtspBackend::kCbc ? 30 : 200;
    ASSERT_EQ(first_costs(matrix, GetParam(), count), brute_costs(matrix, count));
  }
}

TEST_P(KBestTest, ResolvesOnlyUpToTheCutoff) {
  Random random(13);
  const Limits limits;
  for (Variant variant : kVariants) {
    const CostMatrix matrix = metric_matrix(6, variant, random);
    const std::vector<Time> costs = brute_costs(matrix, 100);
    KBestSequences list = list_of(matrix, GetParam(), limits);
    for (std::size_t rank = 0; rank < costs.size(); ++rank) {
      const Time bound = list.resolve(rank, costs[rank] - 1);
      ASSERT_FALSE(list.known(rank));
      ASSERT_GE(bound, costs[rank]);  // the bound proves that the cutoff is exceeded
      ASSERT_EQ(list.resolve(rank, costs[rank]), costs[rank]);
      ASSERT_TRUE(list.known(rank));
    }
  }
}

TEST_P(KBestTest, UnreachableStopLeavesNoSequence) {
  Random random(14);
  CostMatrix matrix = grid_matrix(4, Variant::kCts, random);
  fill_column(matrix, 2, kNever);
  const Limits limits;
  KBestSequences list = list_of(matrix, GetParam(), limits);
  EXPECT_EQ(list.resolve(0, kNever), kNever);
  EXPECT_FALSE(list.known(0));
}

INSTANTIATE_TEST_SUITE_P(, KBestTest, ::testing::ValuesIn(rtsp_backends()), name_of);

class BackendsAgree : public ::testing::Test {
 protected:
  // Compares the costs of the first `count` sequences of n stops with Held-Karp, on every map, with
  // and without a destination.
  void compare(RtspBackend backend, int n, std::size_t count) {
    Random random(static_cast<unsigned>(n));
    for (const char* map : kMaps)
      for (Variant variant : kVariants) {
        const auto matrix = map_matrix(map, n, variant, random);
        if (!matrix) GTEST_SKIP() << "no Moving AI maps here (set GROVE_MOVINGAI)";
        ASSERT_EQ(first_costs(*matrix, backend, count),
                  first_costs(*matrix, RtspBackend::kHeldKarp, count))
            << map << ", n = " << n;
      }
  }
};

TEST_F(BackendsAgree, BoundedDpAndTableOnTheFirst200) {
  for (int n : {9, 12, 15, 18}) compare(RtspBackend::kBoundedDp, n, 200);
}

TEST_F(BackendsAgree, CbcAndTableOnAFewSequences) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "built without CBC";
  compare(RtspBackend::kCbc, 10, 10);
  compare(RtspBackend::kCbc, 14, 3);
}

// Takes minutes, so it runs only if GROVE_LONG_TESTS is set.
TEST_F(BackendsAgree, AllThreeOnTheFirst200UpTo22Stops) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "built without CBC";
  if (std::getenv("GROVE_LONG_TESTS") == nullptr) GTEST_SKIP() << "set GROVE_LONG_TESTS to run";
  for (int n = 9; n <= 22; ++n) {
    compare(RtspBackend::kBoundedDp, n, 200);
    compare(RtspBackend::kCbc, n, 200);
    std::printf("n = %d agrees\n", n);
  }
}

}  // namespace k_best_sequences_test
}  // namespace grove::detail::testing
