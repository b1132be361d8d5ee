// SPDX-License-Identifier: MIT
// Tests single-agent search with a fixed order of goals, with regression cases that an earlier
// low-level search got wrong.
#include "planning/fixed_order_sipp.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "tests/planning/single_agent.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace fixed_order_sipp_test {

using Outcome = PathOutcome;
using testing::grid_of;
using testing::SingleAgent;
using Constraints = std::vector<Constraint>;

constexpr Time kInfeasible = -1;

Path path_of(const Grid& grid, const SingleAgent& agent, const Constraints& constraints,
             const ConflictAvoidanceTable* others = nullptr) {
  FixedOrderSipp search(grid);
  Path path;
  const Outcome outcome = search.find(agent.goals, {constraints, others}, Limits(), path);
  EXPECT_NE(outcome, Outcome::kStopped);
  EXPECT_EQ(outcome == Outcome::kFound, !path.empty());
  return path;
}

Time cost_of(const Grid& grid, const SingleAgent& agent, const Constraints& constraints) {
  return static_cast<Time>(path_of(grid, agent, constraints).size()) - 1;
}

TEST(FixedOrderSipp, VisitsGoalsInTheGivenOrder) {
  const Grid grid = grid_of({"...."});
  const SingleAgent agent(grid, 1, {3, 0}, 2);
  EXPECT_EQ(path_of(grid, agent, {}), (Path{1, 2, 3, 2, 1, 0, 1, 2}));
}

TEST(FixedOrderSipp, EarlyArrivalInDeadEndMayCostMore) {
  const Grid grid = grid_of({"...."});
  const SingleAgent agent(grid, 3, {0}, 3);
  // An agent that is on the task at time 3 can neither leave before time 21 nor stay at time 10.
  EXPECT_EQ(cost_of(grid, agent, {{1, kNoCell, 4, 20}, {0, kNoCell, 10, 10}}), 25);
}

TEST(FixedOrderSipp, PassesItsDestinationAndReturns) {
  const Grid grid = grid_of({"...."});
  const SingleAgent agent(grid, 0, {3}, 1);
  EXPECT_EQ(path_of(grid, agent, {}), (Path{0, 1, 2, 3, 2, 1}));
}

TEST(FixedOrderSipp, LateConstraintOnDestinationDelaysFinish) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {}, 2);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 9, 9}}), 10);
}

TEST(FixedOrderSipp, CellBarredForeverCannotBeTheFinish) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {}, 2);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 50, kNever}}), kInfeasible);
}

TEST(FixedOrderSipp, TaskBarredForeverMustBeReachedBefore) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {2}, 0);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 3, kNever}}), 4);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 2, kNever}}), kInfeasible);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 0, kNever}}), kInfeasible);
}

TEST(FixedOrderSipp, CannotStartOnBarredCell) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {}, 2);
  EXPECT_EQ(cost_of(grid, agent, {{0, kNoCell, 0, 0}}), kInfeasible);
  EXPECT_EQ(cost_of(grid, agent, {{0, kNoCell, -3, 0}}), kInfeasible);
  EXPECT_EQ(cost_of(grid, agent, {{0, kNoCell, 1, 9}}), 2);
}

TEST(FixedOrderSipp, AgentAtItsDestinationCostsNothing) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 1, {1}, 1);
  EXPECT_EQ(path_of(grid, agent, {}), Path{1});
}

TEST(FixedOrderSipp, AgentAtItsDestinationLeavesIfBarredLater) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 1, {}, 1);
  EXPECT_EQ(cost_of(grid, agent, {{1, kNoCell, 5, 5}}), 6);
}

TEST(FixedOrderSipp, TaskOnStartIsVisitedAtTimeZero) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {0}, 2);
  EXPECT_EQ(cost_of(grid, agent, {}), 2);
  EXPECT_EQ(cost_of(grid, agent, {{0, kNoCell, 1, kNever}}), 2);
}

TEST(FixedOrderSipp, TaskOnDestinationIsVisitedOnArrival) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {1, 2}, 2);
  EXPECT_EQ(cost_of(grid, agent, {}), 2);
}

TEST(FixedOrderSipp, AgentWithoutDestinationRestsOnItsLastTask) {
  const Grid grid = grid_of({"...."});
  const SingleAgent agent(grid, 1, {0, 3}, std::nullopt);
  EXPECT_EQ(path_of(grid, agent, {}), (Path{1, 0, 1, 2, 3}));
  EXPECT_EQ(cost_of(grid, agent, {{3, kNoCell, 7, 7}}), 8);
  EXPECT_EQ(cost_of(grid, agent, {{3, kNoCell, 7, kNever}}), kInfeasible);
}

TEST(FixedOrderSipp, EdgeConstraintBarsOneDirectionAtArrivalTime) {
  const Grid grid = grid_of({"..."});
  const SingleAgent there(grid, 0, {}, 2);
  EXPECT_EQ(cost_of(grid, there, {{1, 0, 1, 4}}), 6);
  EXPECT_EQ(cost_of(grid, there, {{0, 1, 0, kNever}}), 2);
  EXPECT_EQ(cost_of(grid, there, {{1, 0, 2, kNever}}), 2);
  EXPECT_EQ(cost_of(grid, there, {{1, 0, 1, kNever}}), kInfeasible);
}

TEST(FixedOrderSipp, IsInfeasibleWhenEveryWaitingPlaceIsBarred) {
  const Grid grid = grid_of({"...", "@.@"});
  const SingleAgent agent(grid, 0, {}, 2);
  // The destination is barred at times 2 and 3. The agent can wait at the start, in the middle or
  // in the niche; these places are barred one after another.
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 2, 3}}), 4);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 2, 3}, {0, kNoCell, 1, 9}}), 4);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 2, 3}, {0, kNoCell, 1, 9}, {1, kNoCell, 2, 2}}), 4);
  EXPECT_EQ(
      cost_of(grid, agent,
              {{2, kNoCell, 2, 3}, {0, kNoCell, 1, 9}, {1, kNoCell, 2, 2}, {4, kNoCell, 2, 2}}),
      kInfeasible);
}

// Tests the gates of fixed_order_goals.h: the first visit of the task leads to no path, but a later
// visit does.
TEST(FixedOrderSipp, LaterVisitIsTriedWhenFirstVisitLeadsNowhere) {
  const Grid grid = grid_of({".....", "@@.@@"});
  const SingleAgent agent(grid, 0, {7}, 4);
  Constraints constraints{{7, kNoCell, 6, 6}, {2, kNoCell, 4, 11}};
  EXPECT_EQ(cost_of(grid, agent, constraints), 12 + 1 + 1 + 2);
  constraints.push_back({7, kNoCell, 13, 13});
  EXPECT_EQ(cost_of(grid, agent, constraints), 12 + 2 + 1 + 2);
  constraints.push_back({7, kNoCell, 14, kNever});
  EXPECT_EQ(cost_of(grid, agent, constraints), kInfeasible);
}

// A gate of goal k, set at time g, postpones a label L only if L cannot visit goal k before g, that
// is, if f(L) >= g + after_goal(k) (fixed_order_goals.h). Here labels for which this condition is
// false are expanded after the gate was set. The gate must not postpone them.
TEST(FixedOrderSipp, GateKeepsLabelsThatReachItsGoalEarlier) {
  const Grid grid = grid_of({".......", "@.@@@@@"});
  const SingleAgent agent(grid, 0, {2, 5}, 6);
  const Constraints constraints{
      {1, kNoCell, 3, 3},     {1, kNoCell, 5, 5},   // possible arrivals on 2: at 2, at 5, from 7 on
      {2, kNoCell, 3, 4},     {2, kNoCell, 6, 6},   //
      {3, kNoCell, 4, 5},     {3, kNoCell, 8, 30},  // arrival from 7 on: a long wait
      {4, kNoCell, 6, 6},     {3, 4, 6, 6},         // arrival at 2: trapped from time 5 on
      {5, kNoCell, 6, 14},    {6, kNoCell, 6, 15},  //
      {8, kNoCell, 0, kNever}};
  ConflictAvoidanceTable others(grid);
  others.add({8, 8, 8, 8, 1, 8});  // makes arriving on 2 at time 5 the second choice
  EXPECT_EQ(path_of(grid, agent, constraints, &others).size(), 17U);
  EXPECT_EQ(cost_of(grid, agent, constraints), 16);
}

TEST(FixedOrderSipp, UnreachableGoalsAreInfeasible) {
  const Grid grid = grid_of({"..@.."});
  EXPECT_EQ(cost_of(grid, SingleAgent(grid, 0, {}, 4), {}), kInfeasible);
  EXPECT_EQ(cost_of(grid, SingleAgent(grid, 0, {3}, 1), {}), kInfeasible);
}

TEST(FixedOrderSipp, WaitsAMillionStepsIfNecessary) {
  const Grid grid = grid_of({"...."});
  const SingleAgent agent(grid, 0, {2}, 3);
  EXPECT_EQ(cost_of(grid, agent, {{2, kNoCell, 1, 999'999}, {3, kNoCell, 5, 5}}), 1'000'001);
}

TEST(FixedOrderSipp, PrefersPathWithFewerConflicts) {
  const Grid grid = grid_of({"...", ".@.", "..."});
  const SingleAgent agent(grid, 0, {}, 8);
  ConflictAvoidanceTable others(grid);
  others.add({1, 1, 2});
  EXPECT_EQ(path_of(grid, agent, {}, &others), (Path{0, 3, 6, 7, 8}));
  others.clear();
  others.add({7});
  EXPECT_EQ(path_of(grid, agent, {}, &others), (Path{0, 1, 2, 5, 8}));
}

TEST(FixedOrderSipp, WaitsWhereNoOtherAgentPasses) {
  const Grid grid = grid_of({"...", ".@.", "..."});
  const SingleAgent agent(grid, 0, {}, 8);
  const Constraints constraints{{8, kNoCell, 1, 6}};  // the agent waits on 5 or on 7
  for (Cell crossed : {5, 7}) {
    ConflictAvoidanceTable others(grid);
    others.add({8, 8, 8, 8, crossed, crossed, 8});
    const Path path = path_of(grid, agent, constraints, &others);
    ASSERT_EQ(path.size(), 8U);
    EXPECT_EQ(path[6], 12 - crossed);
  }
}

TEST(FixedOrderSipp, OneVisitCountsForAllGoalsOnTheCell) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {1}, 2);
  const GoalSequence twice(agent.instance, agent.distances, 0, {0, 0, 0});
  FixedOrderSipp search(grid);
  Path path;
  const Constraints constraints{{1, kNoCell, 2, kNever}};
  ASSERT_EQ(search.find(twice, {constraints}, Limits(), path), Outcome::kFound);
  EXPECT_EQ(path, (Path{0, 1, 2}));
}

TEST(FixedOrderSipp, RejectsConstraintsOutsideTheGrid) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {}, 2);
  FixedOrderSipp search(grid);
  Path path;
  EXPECT_THROW(search.find(agent.goals, {Constraints{{9, kNoCell, 1, 1}}}, Limits(), path),
               std::invalid_argument);
}

TEST(FixedOrderSipp, StopsWithoutAnswerWhenALimitIsReached) {
  const Grid grid = grid_of({"..."});
  const SingleAgent agent(grid, 0, {}, 2);
  FixedOrderSipp search(grid);
  Path path{7};

  Limits late;
  late.set_deadline(testing::kPast);
  EXPECT_EQ(search.find(agent.goals, {}, late, path), Outcome::kStopped);
  EXPECT_EQ(late.reason(), StopReason::kTime);

  Limits narrow;
  narrow.set_memory_limit(1);
  EXPECT_EQ(search.find(agent.goals, {}, narrow, path), Outcome::kStopped);
  EXPECT_EQ(narrow.reason(), StopReason::kMemory);
  EXPECT_EQ(path, Path{7});
  EXPECT_EQ(search.expanded(), 0);

  EXPECT_EQ(search.find(agent.goals, {}, Limits(), path), Outcome::kFound);
  EXPECT_GT(search.expanded(), 0);
}

// A long proof of infeasibility: no move may enter the cell of the task, and the cell itself is
// barred at every second time from 400 to 3998.
TEST(FixedOrderSipp, StopsDuringLongInfeasibilityProof) {
  const Grid grid(100, 100, std::vector<bool>(10'000, true));
  const SingleAgent agent(grid, 0, {5'050}, 9'999);
  Constraints constraints;
  for (Time t = 400; t < 4'000; t += 2) constraints.push_back({5'050, kNoCell, t, t});
  for (Cell next : grid.neighbors(5'050)) constraints.push_back({5'050, next, 0, kNever});
  FixedOrderSipp search(grid);
  Path path;
  EXPECT_EQ(search.find(agent.goals, {constraints}, Limits(), path), Outcome::kInfeasible);
  const std::int64_t whole = search.expanded();
  EXPECT_GT(whole, 5'000);

  const testing::ClockReadingLimit limits(2);
  EXPECT_EQ(search.find(agent.goals, {constraints}, limits, path), Outcome::kStopped);
  EXPECT_GT(search.expanded(), whole);
  EXPECT_LT(search.expanded() - whole, whole);
}

}  // namespace fixed_order_sipp_test
}  // namespace grove::detail
