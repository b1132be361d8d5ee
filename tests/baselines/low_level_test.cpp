// SPDX-License-Identifier: MIT
// Tests the low levels of published methods in three ways: on known pitfalls, against the
// definition on tiny problems (GROVE_FUZZ_FACTOR multiplies their number), and against Grove's own
// low level on larger problems.
#include "baselines/low_level.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <stdexcept>

#include "planning/free_order_sipp.h"
#include "tests/planning/free_problems.h"
#include "tests/planning/free_reference.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace low_level_test {

using testing::FreeProblem;
using testing::instance_of;
using Outcome = PathOutcome;

class Baselines : public ::testing::TestWithParam<LowLevel> {
 protected:
  // Returns the cost of the path, or kNever if no path exists (proven).
  Time cost(const Instance& instance, const std::vector<Constraint>& constraints,
            const Limits& limits = Limits()) {
    const DistanceFields distances(instance);
    AgentStops stops(instance, distances, 0);
    SequenceStages goals(stops, {});
    const auto search = make_agent_planner(GetParam(), instance.grid());
    const Outcome outcome = search->find(goals, {constraints}, limits, path_);
    if (outcome == Outcome::kInfeasible) return kNever;
    EXPECT_EQ(outcome, Outcome::kFound);
    return static_cast<Time>(path_.size()) - 1;
  }

  Path path_;
};

// If the agent is on its first task at time 2, it cannot leave that task in time, so the earliest
// arrival leads to no path.
TEST_P(Baselines, ArriveLateIfEarlyArrivalLeadsNowhere) {
  const Instance instance = instance_of({"....."}, {{{0, 0}, std::nullopt, {{2, 0}, {4, 0}}}});
  EXPECT_EQ(cost(instance, {{1, kNoCell, 3, 4}, {2, kNoCell, 3, 4}, {3, kNoCell, 3, 9}}), 11);
}

// In each further case the cell on which the cheapest path rests is blocked at a later time.
TEST_P(Baselines, DoNotRestOnACellThatIsBlockedLater) {
  const Instance instance = instance_of({"......"}, {{{1, 0}, std::nullopt, {{0, 0}, {5, 0}}}});
  EXPECT_EQ(cost(instance, {}), 6);
  EXPECT_EQ(cost(instance, {{5, kNoCell, 9, 9}}), 9);  // visits its tasks in the reverse order
  EXPECT_EQ(cost(instance, {{5, kNoCell, 9, 9}, {0, kNoCell, 20, 20}}), 10);
  EXPECT_EQ(cost(instance, {{5, kNoCell, 9, kNever}, {0, kNoCell, 20, kNever}}), kNever);
}

TEST_P(Baselines, EndOnlyOnTheDestination) {
  const Instance instance = instance_of({"...."}, {{{0, 0}, Position{1, 0}, {{3, 0}}}});
  EXPECT_EQ(cost(instance, {}), 5);
  EXPECT_EQ(cost(instance, {{1, kNoCell, 7, 7}}), 8);
  EXPECT_EQ(cost(instance, {{0, kNoCell, 0, 0}}), kNever);
}

TEST_P(Baselines, CostNothingWithoutTasksElsewhere) {
  EXPECT_EQ(cost(instance_of({".."}, {{{0, 0}, Position{0, 0}, {}}}), {}), 0);
  EXPECT_EQ(cost(instance_of({".."}, {{{0, 0}, std::nullopt, {{0, 0}}}}), {}), 0);
}

TEST_P(Baselines, RefuseUnsupportedQueries) {
  const Instance instance = instance_of({".."}, {{{0, 0}, Position{1, 0}, {}}});
  EXPECT_THROW(cost(instance, {{1, kNoCell, 0, 5, ConstraintKind::kNoRestBy}}),
               std::invalid_argument);
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages all(stops, {});
  SequenceStages some(stops, {.prefix = {}, .forbidden_next = 1});
  const ReservationTable none(instance.grid());
  const auto search = make_agent_planner(GetParam(), instance.grid());
  EXPECT_THROW(search->find(some, {}, Limits(), path_), std::invalid_argument);
  EXPECT_THROW(search->find(all, {.reservations = &none}, Limits(), path_), std::invalid_argument);
}

TEST_P(Baselines, ReportStoppedAtALimit) {
  const Instance instance = instance_of({".."}, {{{0, 0}, Position{1, 0}, {}}});
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages goals(stops, {});
  const Limits limits;
  limits.stop(StopReason::kTime);
  const auto search = make_agent_planner(GetParam(), instance.grid());
  EXPECT_EQ(search->find(goals, {}, limits, path_), Outcome::kStopped);
}

// If a limit is reached during the search, the result proves nothing.
TEST_P(Baselines, ReportStoppedAtALimitDuringTheSearch) {
  const Instance instance =
      instance_of(std::vector<std::string>(16, std::string(16, '.')),
                  {{{0, 0}, Position{15, 15}, {{15, 0}, {0, 15}, {8, 7}, {12, 3}}}});
  const std::vector<Constraint> constraints = {{15 * 16 + 15, kNoCell, 50, 75}};
  const Time truth = cost(instance, constraints);
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages goals(stops, {});
  const auto search = make_agent_planner(GetParam(), instance.grid());
  const testing::ClockReadingLimit whole(testing::kUnlimitedReadings);
  ASSERT_EQ(search->find(goals, {constraints}, whole, path_), Outcome::kFound);
  ASSERT_EQ(static_cast<Time>(path_.size()) - 1, truth);
  ASSERT_GT(whole.readings(), 3);
  const std::int64_t stride = 1 + whole.readings() / 60;
  for (std::int64_t readings = 0; readings < whole.readings(); readings += stride) {
    SCOPED_TRACE(readings);
    const testing::ClockReadingLimit limits(readings);
    ASSERT_EQ(search->find(goals, {constraints}, limits, path_), Outcome::kStopped);
  }
}

// After the last constraint all arrival times are equivalent, so the earliest one counts.
TEST_P(Baselines, KeepTheEarliestOfEquivalentTimes) {
  const Instance instance = instance_of({".....", ".....", "....."},
                                        {{{3, 2}, Position{3, 1}, {{0, 1}, {3, 1}, {0, 0}}}});
  EXPECT_EQ(cost(instance, {{0, kNoCell, 5, 8}, {8, 7, 9, kNever}, {5, 10, 7, kNever}}), 13);
}

// Tiny maps, with constraints added one at a time.
TEST_P(Baselines, AgreeWithTheDefinition) {
  int infeasible = 0;
  const int seeds = testing::fuzz_rounds(400);
  for (int seed = 0; seed < seeds && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::FreeProblems problems(static_cast<unsigned>(seed), false);
    const Grid grid = problems.grid();
    FreeProblem problem = problems.problem(grid);
    problem.work = {};
    const Instance instance = testing::instance_of(problem);
    const DistanceFields distances(instance);
    AgentStops stops(instance, distances, 0);
    SequenceStages goals(stops, {});
    const auto search = make_agent_planner(GetParam(), grid);
    for (int n = problems.below(12); n >= 0; --n) {
      const std::optional<Time> expected = testing::free_reference_cost(problem);
      const auto find = [&](Time cutoff) {
        return search->find(goals, {problem.constraints, nullptr, cutoff}, Limits(), path_);
      };
      if (!expected) {
        EXPECT_EQ(find(kNever), Outcome::kInfeasible);
        ++infeasible;
        break;
      }
      ASSERT_EQ(find(*expected - 1), Outcome::kAboveCutoff);
      ASSERT_EQ(find(*expected), Outcome::kFound);
      EXPECT_EQ(static_cast<Time>(path_.size()) - 1, *expected);
      EXPECT_EQ(testing::path_error(problem, realized_sequence(goals, path_), path_), "");
      problems.make_harder(problem, path_);
    }
  }
  EXPECT_GT(infeasible, seeds / 8);
}

// Many goals on a larger map; each added constraint blocks the path found before.
TEST_P(Baselines, AgreeWithGrovesLowLevel) {
  std::mt19937 random(7);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 12; ++round) {
    constexpr int kSide = 14;
    std::vector<std::string> rows(kSide, std::string(kSide, '.'));
    for (int y = 1; y < kSide; y += 2)
      for (int x = 0; x < kSide; ++x)
        if (below(3) > 0) rows[y][x] = '@';
    for (std::string& row : rows) row[below(kSide)] = '.';
    std::vector<Position> tasks;
    for (int i = 0; i < 7; ++i) tasks.push_back({2 * i, 2 * below(kSide / 2)});
    const auto goal = below(2) == 0 ? std::optional(Position{13, 12}) : std::nullopt;
    const Instance instance = instance_of(rows, {{{0, 6}, goal, tasks}});
    const DistanceFields distances(instance);
    AgentStops stops(instance, distances, 0);
    SequenceStages goals(stops, {});
    FreeOrderSipp free_order_sipp(instance.grid());
    const auto search = make_agent_planner(GetParam(), instance.grid());
    std::vector<Constraint> constraints;
    for (int n = 0; n < 30; ++n) {
      SCOPED_TRACE(std::to_string(round) + ", " + std::to_string(n));
      Path path;
      const auto expected = free_order_sipp.find(goals, {constraints}, Limits(), path);
      const Outcome outcome = search->find(goals, {constraints}, Limits(), path_);
      if (expected != Outcome::kFound) {
        EXPECT_EQ(outcome, Outcome::kInfeasible);
        break;
      }
      ASSERT_EQ(outcome, Outcome::kFound);
      ASSERT_EQ(path_.size(), path.size());
      const int t = 1 + below(static_cast<int>(path_.size()) - 1);
      Constraint more{path_[t], kNoCell, t, t};
      if (below(3) == 0) more.end += below(20);
      if (path_[t - 1] != path_[t] && below(3) == 0) more.from = path_[t - 1];
      constraints.push_back(more);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Baselines,
                         ::testing::Values(LowLevel::kVisitedSets, LowLevel::kSingleLegs,
                                           LowLevel::kTimeIntervalForest),
                         [](const auto& all) {
                           switch (all.param) {
                             case LowLevel::kVisitedSets:
                               return "VisitedSets";
                             case LowLevel::kSingleLegs:
                               return "SingleLegs";
                             default:
                               return "TimeIntervalForest";
                           }
                         });

}  // namespace low_level_test
}  // namespace grove::detail
