// SPDX-License-Identifier: MIT
// Compares the three back ends with all permutations, on random classes with random cutoffs.
#include "sequencing/rtsp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "brute_force.h"
#include "matrices.h"
#include "sequencing/good_sequence.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::testing {
namespace rtsp_test {

// A back end. `canonical`: the bounded DP uses a graph of canonical sequences even if a graph of
// all sequences is small enough.
struct Solver {
  RtspBackend backend;
  bool canonical = false;
};

std::vector<Solver> solvers() {
  std::vector<Solver> solvers{{RtspBackend::kBoundedDp, true}};
  for (const RtspBackend backend : rtsp_backends()) solvers.push_back({backend});
  return solvers;
}

std::string name_of(const ::testing::TestParamInfo<Solver>& info) {
  const char* names[] = {"Auto", "HeldKarp", "BoundedDp", "Cbc"};
  return info.param.canonical ? "Canonical" : names[static_cast<int>(info.param.backend)];
}

class RtspBackendTest : public ::testing::TestWithParam<Solver> {
 protected:
  std::unique_ptr<RtspSolver> make(const CostMatrix& matrix) const {
    if (GetParam().canonical) return make_bounded_dp(matrix, limits_, 0);
    return make_rtsp_solver(GetParam().backend, matrix, limits_);
  }

  // CBC takes milliseconds where the other back ends take microseconds.
  int rounds() const { return fuzz_rounds(GetParam().backend == RtspBackend::kCbc ? 4 : 16); }

  // Queries one solver object about many classes, in random order and with random cutoffs.
  void expect_true_answers(const CostMatrix& matrix, Random& random) {
    const auto solver = make(matrix);
    const std::vector<Time> all = all_costs(matrix, {});
    if (!all.empty()) {
      ASSERT_LE(solver->root_bound(), all.front());
    }
    expect_true_answer(*solver, matrix, {}, kNever);
    for (int i = 0; i < 6; ++i) {
      const SequenceClass work = random_class(matrix.stops(), random);
      const Time scale = all.empty() ? 20 : all[random() % all.size()];
      expect_true_answer(*solver, matrix, work, random() % 2 == 0 ? kNever : scale);
    }
  }

  void expect_true_answer(RtspSolver& solver, const CostMatrix& matrix, const SequenceClass& work,
                          Time cutoff) {
    const std::vector<Time> costs = all_costs(matrix, work);
    const RtspAnswer answer = solver.best(work, cutoff);
    switch (answer.kind) {
      case RtspAnswer::Kind::kExact: {
        ASSERT_FALSE(costs.empty());
        ASSERT_EQ(answer.cost, costs.front());
        const Sequence sequence = solver.best_sequence(work);
        ASSERT_TRUE(is_complete(matrix, sequence));
        ASSERT_TRUE(belongs(sequence, work));
        ASSERT_EQ(sequence_cost(matrix, sequence), answer.cost);
        break;
      }
      case RtspAnswer::Kind::kAboveCutoff:
        ASSERT_GT(answer.cost, cutoff);
        if (!costs.empty()) {
          ASSERT_LE(answer.cost, costs.front());
        }
        break;
      case RtspAnswer::Kind::kInfeasible:
        ASSERT_TRUE(costs.empty());
        break;
      case RtspAnswer::Kind::kStopped:
        FAIL() << "stopped without a limit";
    }
    if (cutoff == kNever) {
      ASSERT_NE(answer.kind, RtspAnswer::Kind::kAboveCutoff);
    }
  }

  Limits limits_;
};

TEST_P(RtspBackendTest, AgreesWithAllPermutationsOnGrids) {
  Random random(1);
  for (int round = 0; round < rounds(); ++round)
    for (Variant variant : kVariants)
      for (int n = variant == Variant::kCts ? 0 : 1; n <= 7; ++n)
        expect_true_answers(grid_matrix(n, variant, random), random);
}

TEST_P(RtspBackendTest, AgreesWithAllPermutationsOnMetrics) {
  Random random(2);
  for (int round = 0; round < rounds(); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 7; ++n) expect_true_answers(metric_matrix(n, variant, random), random);
}

// The back ends make no assumption about the matrix except for the meaning of kNever.
TEST_P(RtspBackendTest, AgreesWithAllPermutationsOnArbitraryMatrices) {
  Random random(3);
  for (int round = 0; round < rounds(); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 6; ++n) expect_true_answers(wild_matrix(n, variant, random), random);
}

TEST_P(RtspBackendTest, AgreesWithAllPermutationsOfEightStops) {
  Random random(4);
  for (Variant variant : kVariants) {
    expect_true_answers(grid_matrix(8, variant, random), random);
    expect_true_answers(metric_matrix(8, variant, random), random);
  }
}

// Stops on a line, where nearly every order has the same cost as some other order. Some stops share
// a place, and some take time.
CostMatrix line_matrix(int n, Variant variant, Random& random) {
  std::vector<int> places;
  std::vector<Time> durations(static_cast<std::size_t>(n) + 1, 0);
  for (int i = 0; i < n + 2; ++i) places.push_back(static_cast<int>(random() % 10));
  for (int i = 0; i < n; ++i)
    if (random() % 4 == 0) durations[static_cast<std::size_t>(i)] = static_cast<Time>(random() % 3);
  CostMatrix matrix{CostMatrix::Matrix(n + 1)};
  for (int from = 0; from <= n; ++from)
    for (int to = 0; to <= n; ++to) {
      if (from == to && from < n) continue;
      const int there = places[static_cast<std::size_t>(to == n ? n + 1 : to)];
      matrix.cost(from, to) = std::abs(places[static_cast<std::size_t>(from)] - there) +
                              durations[static_cast<std::size_t>(to)];
    }
  if (variant == Variant::kMg) fill_column(matrix, n, 0);
  return matrix;
}

TEST_P(RtspBackendTest, AgreesWithAllPermutationsOnALine) {
  Random random(7);
  for (int round = 0; round < rounds(); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 7; ++n) expect_true_answers(line_matrix(n, variant, random), random);
}

TEST_P(RtspBackendTest, ReturnsSequenceOfAnEarlierCall) {
  Random random(8);
  for (int round = 0; round < rounds(); ++round) {
    const CostMatrix matrix = line_matrix(6, Variant::kCts, random);
    const auto solver = make(matrix);
    const SequenceClass first = random_class(6, random);
    const RtspAnswer answer = solver->best(first, kNever);
    solver->best({}, kNever);
    solver->best(random_class(6, random), kNever);
    if (answer.kind != RtspAnswer::Kind::kExact) continue;
    const Sequence sequence = solver->best_sequence(first);
    EXPECT_TRUE(belongs(sequence, first));
    EXPECT_EQ(sequence_cost(matrix, sequence), answer.cost);
  }
}

// A row of n stops has up to 2^n optimal sequences. Early versions took seconds for 24 stops and
// gigabytes for 30 stops.
TEST(RowsOfStops, AreSequencedInOrder) {
  const Limits limits;
  for (const int n : {24, 40, 64})
    for (const int start : {0, 20, 70}) {
      CostMatrix matrix{CostMatrix::Matrix(n + 1)};
      const auto place = [&](int row) { return row == n ? start : row + 2; };
      for (int from = 0; from <= n; ++from)
        for (int to = 0; to < n; ++to) matrix.cost(from, to) = std::abs(place(from) - place(to));
      for (int from = 0; from <= n; ++from) matrix.cost(from, n) = place(from);
      const Time ends = std::max(place(n - 1), start);
      const Time cost = ends - start + ends;  // to the far end and back to 0
      const auto solver = make_rtsp_solver(RtspBackend::kAuto, matrix, limits);
      const RtspAnswer answer = solver->best({}, kNever);
      EXPECT_EQ(answer.kind, RtspAnswer::Kind::kExact);
      EXPECT_EQ(answer.cost, cost);
      EXPECT_EQ(sequence_cost(matrix, solver->best_sequence({})), cost);
      EXPECT_EQ(sequence_cost(matrix, good_sequence(matrix)), cost);
    }
}

TEST(GoodSequence, IsCompleteAndUsuallyOptimal) {
  Random random(9);
  int best = 0;
  int all = 0;
  for (int round = 0; round < fuzz_rounds(20); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 7; ++n)
        for (const CostMatrix& matrix :
             {grid_matrix(n, variant, random), metric_matrix(n, variant, random)}) {
          const Sequence sequence = good_sequence(matrix);
          ASSERT_TRUE(is_complete(matrix, sequence));
          const std::vector<Time> costs = all_costs(matrix, {});
          if (costs.empty()) continue;
          ASSERT_GE(sequence_cost(matrix, sequence), costs.front());
          best += static_cast<int>(sequence_cost(matrix, sequence) == costs.front());
          ++all;
        }
  EXPECT_GT(10 * best, 9 * all);
}

TEST_P(RtspBackendTest, AnswersWithoutStops) {
  CostMatrix matrix{CostMatrix::Matrix(1, 7)};
  const auto solver = make(matrix);
  const RtspAnswer answer = solver->best({}, kNever);
  EXPECT_EQ(answer.kind, RtspAnswer::Kind::kExact);
  EXPECT_EQ(answer.cost, 7);
  EXPECT_EQ(solver->best_sequence({}), Sequence{});
  matrix.cost(0, 0) = kNever;
  EXPECT_EQ(make(matrix)->best({}, kNever).kind, RtspAnswer::Kind::kInfeasible);
}

TEST_P(RtspBackendTest, UnreachableStopIsInfeasible) {
  Random random(5);
  CostMatrix matrix = grid_matrix(6, Variant::kCts, random);
  for (int to = 0; to < matrix.cost.size(); ++to) matrix.cost(3, to) = kNever;
  fill_column(matrix, 3, kNever);
  const auto solver = make(matrix);
  EXPECT_EQ(solver->best({}, kNever).kind, RtspAnswer::Kind::kInfeasible);
  EXPECT_EQ(solver->best({{1, 2}, 0}, kNever).kind, RtspAnswer::Kind::kInfeasible);
}

// Costs that do not fit in 16 bits.
TEST_P(RtspBackendTest, SolvesCostsAboveSixteenBits) {
  Random random(6);
  for (Variant variant : kVariants) {
    CostMatrix matrix = metric_matrix(7, variant, random);
    scale(matrix, 10'000);
    const auto solver = make(matrix);
    expect_true_answer(*solver, matrix, {}, kNever);
    expect_true_answer(*solver, matrix, {{2}, 9}, kNever);
  }
}

INSTANTIATE_TEST_SUITE_P(, RtspBackendTest, ::testing::ValuesIn(solvers()), name_of);

// Uses only bounds from the relaxation, on matrices with a known optimum.
TEST(RelaxationBound, IsNeverAboveTheOptimum) {
  Random random(7);
  for (int round = 0; round < fuzz_rounds(40); ++round)
    for (Variant variant : kVariants)
      for (int n = 1; n <= 6; ++n)
        for (const CostMatrix& matrix :
             {grid_matrix(n, variant, random), metric_matrix(n, variant, random),
              wild_matrix(n, variant, random)}) {
          const std::vector<Time> costs = all_costs(matrix, {});
          if (!costs.empty()) {
            ASSERT_LE(relaxation_bound(matrix), costs.front());
          }
        }
}

TEST(RelaxationBound, IsExactForUpToTwoStops) {
  Random random(8);
  for (int round = 0; round < fuzz_rounds(20); ++round)
    for (int n = 0; n <= 2; ++n) {
      const CostMatrix matrix = metric_matrix(n, Variant::kCts, random);
      ASSERT_EQ(relaxation_bound(matrix), all_costs(matrix, {}).front());
    }
}

}  // namespace rtsp_test
}  // namespace grove::detail::testing
