// SPDX-License-Identifier: MIT
// Tests limits in sequencing: a stopped call proves neither optimality nor infeasibility, its
// bounds are valid, and no call hangs.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "brute_force.h"
#include "matrices.h"
#include "sequencing/k_best_joint_sequences.h"
#include "tests/support/clocks.h"

namespace grove::detail::testing {
namespace limits_in_sequencing_test {

using testing::ClockReadingLimit;

class LimitsInSequencing : public ::testing::TestWithParam<RtspBackend> {
 protected:
  void expect_stopped(const CostMatrix& matrix, const Limits& limits) {
    const auto solver = make_rtsp_solver(GetParam(), matrix, limits);
    const RtspAnswer answer = solver->best({}, kNever);
    EXPECT_EQ(answer.kind, RtspAnswer::Kind::kStopped);
    EXPECT_LE(answer.cost, all_costs(matrix, {}).front());
    EXPECT_NE(limits.reason(), StopReason::kNone);
  }
};

std::string name_of(const ::testing::TestParamInfo<RtspBackend>& info) {
  const char* names[] = {"Auto", "HeldKarp", "BoundedDp", "Cbc"};
  return names[static_cast<int>(info.param)];
}

TEST_P(LimitsInSequencing, ExpiredDeadlineStops) {
  Random random(51);
  Limits limits;
  limits.set_deadline(testing::kPast);
  expect_stopped(metric_matrix(8, Variant::kCts, random), limits);
}

TEST_P(LimitsInSequencing, LittleMemoryStops) {
  Random random(52);
  Limits limits;
  limits.set_memory_limit(1 << 20);
  expect_stopped(metric_matrix(8, Variant::kCts, random), limits);
}

TEST_P(LimitsInSequencing, InterruptStops) {
  Random random(53);
  const std::atomic<bool> interrupted{true};
  Limits limits;
  limits.watch_interrupt(&interrupted);
  expect_stopped(metric_matrix(8, Variant::kCts, random), limits);
}

// Random points in the plane, with distances on so fine a scale that few costs are equal. 64 points
// are far too many for the time limit.
CostMatrix points_in_the_plane(int n, Random& random) {
  std::vector<std::pair<Time, Time>> at;
  for (int i = 0; i <= n; ++i)
    at.emplace_back(static_cast<Time>(random() % 100'000), static_cast<Time>(random() % 100'000));
  CostMatrix matrix{CostMatrix::Matrix(n + 1)};
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < n; ++j)
      matrix.cost(i, j) =
          static_cast<Time>(std::hypot(at[i].first - at[j].first, at[i].second - at[j].second));
  return matrix;
}

TEST_P(LimitsInSequencing, StopsInTime) {
  Random random(54);
  const CostMatrix matrix = points_in_the_plane(64, random);
  ClockReadingLimit limits(20);
  limits.set_memory_limit(resident_bytes() + (std::size_t{1} << 30));
  const auto solver = make_rtsp_solver(GetParam(), matrix, limits);
  const RtspAnswer answer = solver->best({}, kNever);
  EXPECT_EQ(answer.kind, RtspAnswer::Kind::kStopped);
  EXPECT_GE(answer.cost, solver->root_bound());
}

TEST_P(LimitsInSequencing, ListKeepsItsEntriesAndBoundsTheOthers) {
  Random random(55);
  const CostMatrix matrix = metric_matrix(7, Variant::kMg, random);
  const std::vector<Time> costs = all_costs(matrix, {});
  std::atomic<bool> interrupted{false};
  Limits limits;
  limits.watch_interrupt(&interrupted);
  KBestSequences list(make_rtsp_solver(GetParam(), matrix, limits), matrix, limits);
  EXPECT_EQ(list.resolve(2, kNever), costs[2]);
  interrupted = true;
  EXPECT_LE(list.resolve(50, kNever), costs[50]);
  EXPECT_FALSE(list.known(50));
  EXPECT_EQ(list.cost_bound(2), costs[2]);
  EXPECT_EQ(sequence_cost(matrix, list.sequence(1)), costs[1]);
}

TEST_P(LimitsInSequencing, JointListEndsWithoutClaimingCompleteness) {
  Random random(56);
  const CostMatrix one = metric_matrix(6, Variant::kCts, random);
  const CostMatrix two = metric_matrix(5, Variant::kMg, random);
  const Cost best = all_costs(one, {}).front() + all_costs(two, {}).front();
  Limits limits;
  limits.set_deadline(testing::kPast);
  std::vector<KBestSequences> lists;
  for (const CostMatrix* matrix : {&one, &two})
    lists.emplace_back(make_rtsp_solver(GetParam(), *matrix, limits), *matrix, limits);
  KBestJointSequences joint(std::move(lists), limits);
  EXPECT_FALSE(joint.next());
  EXPECT_LE(joint.lower_bound(), best);
}

INSTANTIATE_TEST_SUITE_P(, LimitsInSequencing, ::testing::ValuesIn(rtsp_backends()), name_of);

// A table too large for any memory is refused before it is allocated.
TEST(HeldKarp, RefusesTableOfFortyStops) {
  const CostMatrix matrix{CostMatrix::Matrix(41, 3)};
  const Limits limits;
  const auto solver = make_rtsp_solver(RtspBackend::kHeldKarp, matrix, limits);
  EXPECT_EQ(solver->best({}, kNever).kind, RtspAnswer::Kind::kStopped);
  EXPECT_EQ(limits.reason(), StopReason::kMemory);
}

RtspAnswer::Kind answer_of_held_karp(const CostMatrix& matrix, const Limits& limits) {
  return make_rtsp_solver(RtspBackend::kHeldKarp, matrix, limits)->best({}, kNever).kind;
}

TEST(HeldKarp, StopsInTheMiddleOfTheTable) {
  Random random(58);
  const CostMatrix matrix = points_in_the_plane(20, random);
  const ClockReadingLimit whole(kUnlimitedReadings);
  EXPECT_EQ(answer_of_held_karp(matrix, whole), RtspAnswer::Kind::kExact);
  ASSERT_GT(whole.readings(), 20);
  const ClockReadingLimit limits(whole.readings() / 10);
  EXPECT_EQ(answer_of_held_karp(matrix, limits), RtspAnswer::Kind::kStopped);
  EXPECT_LT(limits.readings(), whole.readings() / 5);
}

TEST(Cbc, ServesThreadsOneAtATime) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "built without CBC";
  Random random(57);
  const CostMatrix matrix = metric_matrix(6, Variant::kCts, random);
  const Time best = all_costs(matrix, {}).front();
  const Limits limits;
  std::atomic<int> right{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      const auto solver = make_rtsp_solver(RtspBackend::kCbc, matrix, limits);
      right += solver->best({}, kNever).cost == best;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 4);
}

}  // namespace limits_in_sequencing_test
}  // namespace grove::detail::testing
