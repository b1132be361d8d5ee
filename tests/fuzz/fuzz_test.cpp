// SPDX-License-Identifier: MIT
// Tests of the fuzzer: it must detect every kind of false claim and shrink the failing case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <stdexcept>
#include <thread>

#include "tests/fuzz/campaign.h"
#include "tests/fuzz/shrink.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {
namespace fuzz_test {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A correct solver, which returns the answer of the oracle.
Solution honest(const Instance&, const SolveOptions& options, const Limits& limits,
                const oracle::Answer& truth) {
  Solution solution;
  solution.omega = options.omega;
  if (limits.stop_requested()) return solution;
  solution.plan = truth.plan;
  solution.status = truth.plan ? Status::kOptimal : Status::kInfeasible;
  solution.lower_bound = truth.plan ? truth.plan->cost : 0;
  return solution;
}

// Returns a solver that applies `twist` to the answer of the oracle.
Solver false_solver(const std::function<void(const Instance&, Solution&)>& twist) {
  return [twist](const Instance& instance, const SolveOptions& options, const Limits& limits,
                 const oracle::Answer& truth) {
    Solution solution = honest(instance, options, limits, truth);
    twist(instance, solution);
    return solution;
  };
}

std::vector<std::string> complaints(const char* text, const Solver& solver) {
  return run_case(FuzzCase::parse(text), solver).complaints;
}

constexpr const char* kCorner = "map\n...\n...\nagents\n0,0 -> 2,0\n2,0 -> 0,0\ntasks\n1,1: 0\n";
constexpr const char* kSwap = "map\n...\nagents\n0,0 -> 2,0\n2,0 -> 0,0\n";
constexpr const char* kFourSteps = "map\n.....\nagents\n0,0 -> 4,0\n";

// Makes the plan one step longer by an initial wait of agent 0.
void delay(Solution& solution) {
  AgentPlan& agent = solution.plan->agents[0];
  agent.path.insert(agent.path.begin(), agent.path.front());
  ++agent.cost;
  ++solution.plan->cost;
}

TEST(Fuzzer, AcceptsTrueAnswers) {
  Tally tally;
  const auto failure = run_campaign({.count = 300, .seed = 1}, honest, tally);
  EXPECT_FALSE(failure) << failure->report();
  EXPECT_EQ(tally.passed + tally.too_large, 300);
  EXPECT_GT(tally.by_status["optimal"], 0);
  EXPECT_GT(tally.by_status["infeasible"], 0);
  EXPECT_GT(tally.by_status["unknown"], 0);
}

TEST(Fuzzer, CatchesWrongCost) {
  EXPECT_THAT(complaints(kCorner, false_solver([](auto&, Solution& s) {
                           --s.plan->cost;
                           --s.lower_bound;
                         })),
              Contains(HasSubstr("below the optimum")));
  EXPECT_THAT(
      complaints(kCorner, false_solver([](auto&, Solution& s) { --s.plan->agents[0].cost; })),
      Contains(HasSubstr("the plan is invalid")));
}

TEST(Fuzzer, CatchesBoundAboveOptimum) {
  EXPECT_THAT(complaints(kCorner, false_solver([](auto&, Solution& s) { ++s.lower_bound; })),
              Contains(HasSubstr("exceeds the optimum")));
  // A false bound is detected even if a stopped run reports it without a plan.
  EXPECT_THAT(complaints("map\n..\nagents\n0,0 -> 1,0\noptions\nstrike expired\n",
                         false_solver([](auto&, Solution& s) { s.lower_bound = 2; })),
              Contains(HasSubstr("exceeds the optimum")));
}

TEST(Fuzzer, CatchesFalseInfeasibility) {
  EXPECT_THAT(complaints(kCorner, false_solver([](auto&, Solution& s) {
                           s.plan.reset();
                           s.status = Status::kInfeasible;
                         })),
              Contains(HasSubstr("infeasible, but a plan")));
}

TEST(Fuzzer, CatchesFalseOptimality) {
  const Solver solver = false_solver([](auto&, Solution& s) {
    delay(s);
    ++s.lower_bound;
  });
  EXPECT_THAT(complaints(kFourSteps, solver), Contains(HasSubstr("optimal with cost 5")));
  // The claimed bound no longer matches the plan, so the solution contradicts itself.
  EXPECT_THAT(complaints(kFourSteps, false_solver([](auto&, Solution& s) { delay(s); })),
              Contains(HasSubstr("status optimal where")));
}

TEST(Fuzzer, CatchesFalseBoundedness) {
  const Solver solver = false_solver([](auto&, Solution& s) {
    delay(s);
    s.lower_bound = 5;
    delay(s);
    s.status = Status::kBounded;
  });
  const auto wrong = complaints("map\n.....\nagents\n0,0 -> 4,0\noptions\nomega 0.25\n", solver);
  EXPECT_THAT(wrong, Contains(HasSubstr("bounded with cost 6")));
}

TEST(Fuzzer, CatchesCollisionsInPlans) {
  const Solver solver = [](const Instance& instance, const SolveOptions&, const Limits&,
                           const oracle::Answer&) {
    Solution solution;
    solution.status = Status::kOptimal;
    solution.lower_bound = 4;
    solution.plan = Plan{4, {{2, {}, {0, 1, 2}}, {2, {}, {2, 1, 0}}}};
    EXPECT_EQ(instance.agent_count(), 2);
    return solution;
  };
  EXPECT_THAT(complaints(kSwap, solver), Contains(HasSubstr("but there is none")));
  EXPECT_THAT(complaints("map\n...\n...\nagents\n0,0 -> 2,0\n2,0 -> 0,0\n", solver),
              Contains(HasSubstr("the plan is invalid")));
}

TEST(Fuzzer, CatchesUnknownStatusWithoutALimit) {
  const Solver solver = false_solver([](auto&, Solution& s) {
    s.plan.reset();
    s.status = Status::kUnknown;
  });
  EXPECT_THAT(complaints(kCorner, solver), Contains(HasSubstr("no limit was reached")));
  EXPECT_THAT(complaints("map\n..\nagents\n0,0 -> 1,0\noptions\nomega inf\n", solver), IsEmpty());
  EXPECT_THAT(complaints("map\n..\nagents\n0,0 -> 1,0\noptions\nstrike expired\n", solver),
              IsEmpty());
}

TEST(Fuzzer, CatchesExceptionsOverrunsAndNondeterminism) {
  const Solver thrower = [](const Instance&, const SolveOptions&, const Limits&,
                            const oracle::Answer&) -> Solution {
    throw std::runtime_error("out of luck");
  };
  EXPECT_THAT(complaints(kSwap, thrower), Contains(HasSubstr("threw: out of luck")));
  const Solver deaf = false_solver([](auto&, auto&) {
    const std::clock_t begin = std::clock();
    while (std::clock() - begin < 7 * CLOCKS_PER_SEC / 2) continue;
  });
  EXPECT_THAT(complaints("map\n..\nagents\n0,0 -> 1,0\noptions\nstrike expired\n", deaf),
              Contains(HasSubstr("after the deadline")));
  bool late = false;
  const Solver whimsical = [&late](const Instance& i, const SolveOptions& o, const Limits& l,
                                   const oracle::Answer& truth) {
    Solution solution = honest(i, o, l, truth);
    if (std::exchange(late, !late)) delay(solution);
    solution.status = status_of(solution.plan->cost, solution.lower_bound, o.omega);
    return solution;
  };
  EXPECT_THAT(complaints("map\n.....\nagents\n0,0 -> 4,0\noptions\nomega 0.5\n", whimsical),
              Contains(HasSubstr("differently the second time")));
}

TEST(Fuzzer, CountsRunsThatReachTheTimeLimit) {
  const Solver slow = [](const Instance&, const SolveOptions& options, const Limits& limits,
                         const oracle::Answer&) {
    while (!limits.stop_requested()) std::this_thread::yield();
    Solution solution;
    solution.omega = options.omega;
    return solution;
  };
  Tally tally;
  const auto failure =
      run_campaign({.count = 40, .patience = std::chrono::milliseconds(10)}, slow, tally);
  EXPECT_FALSE(failure) << failure->report();
  EXPECT_GT(tally.unstopped, 20);
  EXPECT_EQ(tally.unsolved_percent(), 100);
}

TEST(Shrink, FindsMinimalCaseOfFalseClaim) {
  // This solver claims a false bound if an MG agent has a task on another agent's destination. A
  // plan exists only if the MG agent has a second task, on which it can finish.
  const Solver solver = false_solver([](const Instance& instance, Solution& s) {
    for (const Task& task : instance.tasks())
      for (const Agent& agent : instance.agents())
        if (agent.goal == task.cell && !instance.agent(task.agents[0]).goal) s.lower_bound = 1000;
  });
  Tally tally;
  const auto failure = run_campaign({.count = 1000, .seed = 3}, solver, tally);
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->result.complaints, Contains(HasSubstr("exceeds the optimum")));
  EXPECT_EQ(failure->shrunk.instance.agents.size(), 2u) << failure->report();
  EXPECT_EQ(failure->shrunk.instance.tasks.size(), 2u) << failure->report();
  EXPECT_EQ(failure->shrunk.options.omega, Omega());
  EXPECT_THAT(failure->report(), HasSubstr(failure->shrunk.to_text()));
}

TEST(Shrink, OffersOnlyValidAndSimplerCases) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const FuzzCase fuzz_case = random_case(seed);
    for (const FuzzCase& simpler : simpler_cases(fuzz_case)) {
      EXPECT_NO_THROW(simpler.instance.build());
      EXPECT_NE(simpler.to_text(), fuzz_case.to_text());
    }
  }
}

TEST(Shrink, RemovesUnusedRowsAndColumns) {
  const FuzzCase fuzz_case = FuzzCase::parse("map\n@...\n@@@.\n@@@.\nagents\n1,0 -> 3,2\n");
  const FuzzCase shrunk = shrink(
      fuzz_case, [](const FuzzCase& c) { return c.instance.agents.size() == 1; }, Limits());
  EXPECT_EQ(shrunk.instance.to_text(), "map\n.@\n@.\nagents\n0,0 -> 1,1\n");
}

TEST(FuzzCase, RoundTripsThroughText) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const FuzzCase fuzz_case = random_case(seed);
    EXPECT_EQ(FuzzCase::parse(fuzz_case.to_text()).to_text(), fuzz_case.to_text());
  }
  EXPECT_THROW(FuzzCase::parse("map\n..\nagents\n0,0 -> 1,0\noptions\nrtsp gurobi\n"),
               std::invalid_argument);
  EXPECT_THROW(FuzzCase::parse("map\n..\nagents\n0,0 -> 1,0\noptions\nlucky 1\n"),
               std::invalid_argument);
}

}  // namespace fuzz_test
}  // namespace grove::detail::fuzz
