// SPDX-License-Identifier: MIT
// The three back ends against all permutations, on random classes with random cutoffs.
#include "grove/detail/sequencing/rtsp.h"

#include <gtest/gtest.h>

#include "brute_force.h"
#include "matrices.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::testing {
namespace rtsp_test {

std::string name_of(const ::testing::TestParamInfo<RtspBackend>& info) {
  const char* names[] = {"Auto", "HeldKarp", "BoundedDp", "Cbc"};
  return names[static_cast<int>(info.param)];
}

class RtspBackendTest : public ::testing::TestWithParam<RtspBackend> {
 protected:
  // CBC takes milliseconds where the others take microseconds.
  int rounds() const { return fuzz_rounds(GetParam() == RtspBackend::kCbc ? 4 : 16); }

  // Asks one solver about many classes, in any order and with any cutoffs.
  void expect_true_answers(const CostMatrix& matrix, Random& random) {
    const auto solver = make_rtsp_solver(GetParam(), matrix, limits_);
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
      case RtspAnswer::Kind::kAbove:
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
      ASSERT_NE(answer.kind, RtspAnswer::Kind::kAbove);
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

// Nothing but the meaning of kNever is assumed of a matrix.
TEST_P(RtspBackendTest, AgreesWithAllPermutationsOnMatricesWithoutAnyOrder) {
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

TEST_P(RtspBackendTest, AnswersWithoutStops) {
  CostMatrix matrix{CostMatrix::Matrix::Constant(1, 1, 7)};
  const auto solver = make_rtsp_solver(GetParam(), matrix, limits_);
  const RtspAnswer answer = solver->best({}, kNever);
  EXPECT_EQ(answer.kind, RtspAnswer::Kind::kExact);
  EXPECT_EQ(answer.cost, 7);
  EXPECT_EQ(solver->best_sequence({}), Sequence{});
  matrix.cost(0, 0) = kNever;
  EXPECT_EQ(make_rtsp_solver(GetParam(), matrix, limits_)->best({}, kNever).kind,
            RtspAnswer::Kind::kInfeasible);
}

TEST_P(RtspBackendTest, CallsAnUnreachableStopInfeasible) {
  Random random(5);
  CostMatrix matrix = grid_matrix(6, Variant::kCts, random);
  matrix.cost.row(3).setConstant(kNever);
  matrix.cost.col(3).setConstant(kNever);
  const auto solver = make_rtsp_solver(GetParam(), matrix, limits_);
  EXPECT_EQ(solver->best({}, kNever).kind, RtspAnswer::Kind::kInfeasible);
  EXPECT_EQ(solver->best({{1, 2}, 0}, kNever).kind, RtspAnswer::Kind::kInfeasible);
}

// Costs that do not fit 16 bits.
TEST_P(RtspBackendTest, TakesLongWays) {
  Random random(6);
  for (Variant variant : kVariants) {
    CostMatrix matrix = metric_matrix(7, variant, random);
    for (Time& cost : matrix.cost.reshaped()) cost *= 10'000;
    const auto solver = make_rtsp_solver(GetParam(), matrix, limits_);
    expect_true_answer(*solver, matrix, {}, kNever);
    expect_true_answer(*solver, matrix, {{2}, 9}, kNever);
  }
}

INSTANTIATE_TEST_SUITE_P(, RtspBackendTest,
                         ::testing::ValuesIn(rtsp_backends()), name_of);

// Bounds from relaxation alone, where the optimum is known.
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
