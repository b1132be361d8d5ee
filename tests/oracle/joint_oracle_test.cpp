// SPDX-License-Identifier: MIT
#include "tests/oracle/joint_oracle.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "model/check.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/layered_search.h"

namespace grove::detail::oracle {
namespace joint_oracle_test {

Answer solve_text(const char* text) {
  return solve_jointly(fuzz::TinyInstance::parse(text).build());
}

// Returns the optimal cost, or -1 if there is no plan.
Cost optimum(const char* text) {
  const Answer answer = solve_text(text);
  EXPECT_NE(answer.verdict, Verdict::kTooLarge);
  return answer.plan ? answer.plan->cost : -1;
}

TEST(JointOracle, SingleAgentTakesItsShortestTour) {
  EXPECT_EQ(optimum("map\n......\nagents\n2,0 -> 3,0\ntasks\n0,0: 0\n5,0: 0\n"), 9);
  EXPECT_EQ(optimum("map\n...\n.@.\n...\nagents\n0,0 -> 2,2\n"), 4);
}

TEST(JointOracle, AgentAtItsDestinationCostsNothing) {
  EXPECT_EQ(optimum("map\n..\nagents\n0,0 -> 0,0\n1,0 -> 1,0\n"), 0);
}

TEST(JointOracle, TaskOnStartIsVisitedAtTimeZero) {
  EXPECT_EQ(optimum("map\n...\nagents\n1,0 -> 2,0\ntasks\n1,0: 0\n"), 1);
  EXPECT_EQ(optimum("map\n...\nagents\n1,0 -> -\ntasks\n1,0: 0\n"), 0);
}

TEST(JointOracle, AgentAtItsDestinationMustLeaveForItsTask) {
  EXPECT_EQ(optimum("map\n...\nagents\n0,0 -> 0,0\ntasks\n2,0: 0\n"), 4);
}

TEST(JointOracle, AgentLeavesItsDestinationForAnotherToPass) {
  // Agent 0 is at its destination but blocks agent 1. It therefore leaves and returns at time 3.
  EXPECT_EQ(optimum("map\n.....\n@@.@@\nagents\n2,0 -> 2,0\n0,0 -> 4,0\n"), 2 + 5);
  // In a longer corridor agent 0 waits before it leaves, and returns at time 4.
  EXPECT_EQ(optimum("map\n.......\n@@@.@@@\nagents\n3,0 -> 3,0\n0,0 -> 6,0\n"), 4 + 6);
}

TEST(JointOracle, SwappingInACorridorIsImpossible) {
  const Answer answer = solve_text("map\n....\nagents\n0,0 -> 3,0\n3,0 -> 0,0\n");
  EXPECT_EQ(answer.verdict, Verdict::kInfeasible);
  EXPECT_FALSE(answer.plan);
}

TEST(JointOracle, SwappingNeighborsIsAnEdgeConflict) {
  EXPECT_EQ(optimum("map\n..\nagents\n0,0 -> 1,0\n1,0 -> 0,0\n"), -1);
  EXPECT_EQ(optimum("map\n..\n..\nagents\n0,0 -> 1,0\n1,0 -> 0,0\n"), 4);
}

TEST(JointOracle, FourAgentsMayRotate) {
  EXPECT_EQ(optimum("map\n..\n..\nagents\n0,0 -> 1,0\n1,0 -> 1,1\n1,1 -> 0,1\n0,1 -> 0,0\n"), 4);
}

TEST(JointOracle, BayMakesTheSwapPossible) {
  // One agent enters the bay at (2, 1) and leaves it again, which costs 2 more steps; the other
  // waits 1 step.
  EXPECT_EQ(optimum("map\n.....\n@@.@@\nagents\n0,0 -> 4,0\n4,0 -> 0,0\n"), 8 + 3);
}

TEST(JointOracle, RestingAgentBlocksTaskOfAnother) {
  // Agent 1 has a task on agent 0's destination at the end of a corridor: agent 0 has to let it in
  // first.
  EXPECT_EQ(optimum("map\n...\n@.@\nagents\n1,1 -> 2,0\n0,0 -> 0,0\ntasks\n2,0: 1\n"), 4 + 5);
}

TEST(JointOracle, RestingAgentMayMakeTheInstanceInfeasible) {
  // Agent 1 cannot get behind agent 0, and agent 0 cannot step aside.
  EXPECT_EQ(optimum("map\n...\nagents\n1,0 -> 1,0\n0,0 -> 0,0\ntasks\n2,0: 1\n"), -1);
}

TEST(JointOracle, MgAgentChoosesWhereToFinish) {
  EXPECT_EQ(optimum("map\n.....\nagents\n1,0 -> -\ntasks\n0,0: 0\n4,0: 0\n"), 1 + 4);
  // Agent 1 rests on (4, 0), so agent 0 must return and finish at (0, 0).
  EXPECT_EQ(optimum("map\n.....\n...@@\nagents\n1,0 -> -\n0,1 -> 4,0\ntasks\n0,0: 0\n4,0: 0\n"),
            7 + 8);
}

TEST(JointOracle, TwoMgAgentsCannotFinishOnOneCell) {
  EXPECT_EQ(optimum("map\n...\n...\nagents\n0,0 -> -\n2,0 -> -\ntasks\n1,0: 0 1\n"), -1);
}

TEST(JointOracle, UnreachableCellsHaveNoPlan) {
  EXPECT_EQ(optimum("map\n.@.\nagents\n0,0 -> 2,0\n"), -1);
  EXPECT_EQ(optimum("map\n.@.\nagents\n0,0 -> 0,0\ntasks\n2,0: 0\n"), -1);
}

TEST(JointOracle, ReportsTooManyStates) {
  const auto instance =
      fuzz::TinyInstance::parse("map\n....\n....\n@.@@\nagents\n0,0 -> 3,0\n3,0 -> 0,0\n").build();
  EXPECT_EQ(solve_jointly(instance, 5).verdict, Verdict::kTooLarge);
}

TEST(JointOracle, PlansAreValid) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const fuzz::TinyInstance tiny = fuzz::any_instance(seed);
    const Instance instance = tiny.build();
    const Answer answer = solve_jointly(instance);
    if (!answer.plan) continue;
    const Solution solution{.status = Status::kOptimal,
                            .plan = answer.plan,
                            .lower_bound = answer.plan->cost,
                            .omega = {},
                            .stats = {}};
    for (const Violation& wrong : check(instance, solution))
      ADD_FAILURE() << wrong.json_pointer << ": " << wrong.message << "\n" << tiny.to_text();
  }
}

TEST(JointOracle, AgreesWithLayeredSearch) {
  const char* more = std::getenv("GROVE_FUZZ_ROUNDS");
  const std::uint64_t rounds = more ? std::strtoull(more, nullptr, 10) : 300;
  int solved = 0;
  int infeasible = 0;
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    const fuzz::TinyInstance tiny =
        seed % 2 == 0 ? fuzz::random_instance(seed, 2) : fuzz::random_world(seed);
    if (tiny.agents.size() != 2) continue;
    const Instance instance = tiny.build();
    const Answer answer = solve_jointly(instance);
    const std::optional<Cost> second = solve_two_agents(instance);
    ASSERT_NE(answer.verdict, Verdict::kTooLarge) << tiny.to_text();
    const auto cost = answer.plan ? std::optional(answer.plan->cost) : std::nullopt;
    ASSERT_EQ(cost, second) << tiny.to_text();
    ++(second ? solved : infeasible);
  }
  EXPECT_GT(solved, 0);
  EXPECT_GT(infeasible, 0);
}

}  // namespace joint_oracle_test
}  // namespace grove::detail::oracle
