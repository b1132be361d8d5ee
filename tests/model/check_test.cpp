// SPDX-License-Identifier: MIT
// Tests of the checker. Most tests make one change that invalidates a valid plan.
#include "model/check.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace grove::detail {
namespace check_test {

using Ids = std::vector<std::string>;

// x: 0 1 2 3 4
//    . . . . .
//    . @ . @ .
//    . . . . .
// a goes from (0, 0) to (4, 0) via t0 (2, 0) and t1 (4, 2); b from (4, 1) to (0, 2) via t1;
// m (no goal) from (0, 1) via t2 (0, 0).
Instance instance() {
  std::vector<bool> passable(15, true);
  passable[6] = passable[8] = false;
  InstanceBuilder builder(Grid(5, 3, passable));
  builder.add_agent("a", {0, 0}, Position{4, 0});
  builder.add_agent("b", {4, 1}, Position{0, 2});
  builder.add_agent("m", {0, 1}, std::nullopt);
  builder.add_task("t0", {2, 0}, Ids{"a"});
  builder.add_task("t1", {4, 2}, Ids{"a", "b"});
  builder.add_task("t2", {0, 0}, Ids{"m"});
  return std::move(builder).build();
}

constexpr Cell at(int x, int y) {
  return 5 * y + x;
}

// Costs 8 + 5 + 2 = 15; m waits for one step.
Solution valid_solution() {
  Plan plan;
  plan.cost = 15;
  plan.agents = {
      {8,
       {0, 1},
       {at(0, 0), at(1, 0), at(2, 0), at(3, 0), at(4, 0), at(4, 1), at(4, 2), at(4, 1), at(4, 0)}},
      {5, {1}, {at(4, 1), at(4, 2), at(3, 2), at(2, 2), at(1, 2), at(0, 2)}},
      {2, {2}, {at(0, 1), at(0, 1), at(0, 0)}},
  };
  Solution solution;
  solution.status = Status::kBounded;
  solution.plan = plan;
  solution.lower_bound = 14;
  solution.omega = Omega::parse("0.1");
  return solution;
}

// Returns the violations of the valid solution after `change`, one line "place: message" for each.
std::string verdict(const std::function<void(Solution&)>& change) {
  Solution solution = valid_solution();
  change(solution);
  const auto violations = check(instance(), solution);
  std::string text;
  for (const Violation& violation : violations)
    text += (text.empty() ? "" : "\n") + violation.json_pointer + ": " + violation.message;
  return text;
}

// Like verdict(change), but changes one agent's plan.
std::string verdict(AgentIndex agent, const std::function<void(AgentPlan&)>& change) {
  return verdict([&](Solution& solution) { change(solution.plan->agents[agent]); });
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
#define EXPECT_MENTIONS(text, part) EXPECT_PRED2(mentions, text, part)

TEST(Check, AcceptsAValidPlan) {
  EXPECT_EQ(verdict([](Solution&) {}), "");
}

TEST(Check, AcceptsTrailingWaitsWithoutCost) {
  EXPECT_EQ(verdict(1, [](AgentPlan& b) { b.path.insert(b.path.end(), 7, b.path.back()); }), "");
}

TEST(Check, AcceptsEveryCorrectStatus) {
  const auto with = [](Status status, Cost bound, const char* omega) {
    return verdict([&](Solution& solution) {
      solution.status = status;
      solution.lower_bound = bound;
      solution.omega = Omega::parse(omega);
    });
  };
  EXPECT_EQ(with(Status::kOptimal, 15, "0"), "");
  EXPECT_EQ(with(Status::kOptimal, 15, "inf"), "");
  EXPECT_EQ(with(Status::kBounded, 14, "0.072"), "");
  EXPECT_EQ(with(Status::kFeasible, 14, "0.07"), "");
  EXPECT_EQ(with(Status::kFeasible, 0, "inf"), "");
}

TEST(Check, RefusesAWrongStatus) {
  const auto with = [](Status status, Cost bound, const char* omega) {
    return verdict([&](Solution& solution) {
      solution.status = status;
      solution.lower_bound = bound;
      solution.omega = Omega::parse(omega);
    });
  };
  EXPECT_MENTIONS(with(Status::kOptimal, 14, "0.1"),
                  "/status: found 'optimal'; expected 'bounded'");
  EXPECT_MENTIONS(with(Status::kBounded, 14, "0.07"),
                  "/status: found 'bounded'; expected 'feasible'");
  EXPECT_MENTIONS(with(Status::kBounded, 14, "inf"),
                  "/status: found 'bounded'; expected 'feasible'");
  EXPECT_MENTIONS(with(Status::kBounded, 15, "0.1"),
                  "/status: found 'bounded'; expected 'optimal'");
  EXPECT_MENTIONS(with(Status::kFeasible, 14, "0.1"),
                  "/status: found 'feasible'; expected 'bounded'");
  EXPECT_MENTIONS(with(Status::kUnknown, 14, "0.1"), "/status: found 'unknown'");
  EXPECT_MENTIONS(with(Status::kInfeasible, 14, "0.1"), "/status: found 'infeasible'");
}

TEST(Check, RefusesAnImpossibleBound) {
  const auto with_bound = [](Cost bound) {
    return verdict([&](Solution& solution) { solution.lower_bound = bound; });
  };
  EXPECT_MENTIONS(with_bound(16), "/lower_bound: found 16; expected at most 15");
  EXPECT_MENTIONS(with_bound(-1), "/lower_bound: found -1");
  EXPECT_MENTIONS(with_bound(kInfiniteCost), "/lower_bound");
}

TEST(Check, RefusesAnswersWithoutAPlan) {
  for (Status status : {Status::kUnknown, Status::kInfeasible, Status::kOptimal})
    EXPECT_MENTIONS(verdict([&](Solution& solution) {
                      solution.status = status;
                      solution.plan.reset();
                    }),
                    "/status: there is no plan");
}

TEST(Check, RefusesPartialPlans) {
  EXPECT_MENTIONS(verdict([](Solution& s) { s.plan->agents.pop_back(); }),
                  "/agents: the plan has 2 agents; expected 3");
  EXPECT_MENTIONS(verdict([](Solution& s) { s.plan->agents.clear(); }),
                  "/agents: the plan has 0 agents");
  EXPECT_MENTIONS(verdict([](Solution& s) { s.plan->agents.emplace_back(); }),
                  "/agents: the plan has 4 agents");
  EXPECT_MENTIONS(verdict(1, [](AgentPlan& b) { b = {}; }), "/agents/1: agent 'b' has no path");
}

TEST(Check, RefusesAWrongTotalCost) {
  EXPECT_MENTIONS(verdict([](Solution& s) { s.plan->cost = 14; }),
                  "/cost: the agents' costs add up to 15, but the plan claims 14");
}

TEST(Check, RefusesAWrongAgentCost) {
  EXPECT_EQ(verdict(1, [](AgentPlan& b) { b.cost = 4; }),
            "/agents/1/cost: agent 'b' finishes at time 5, but the plan claims 4");
}

TEST(Check, CountsWaitsBeforeTheFinish) {
  EXPECT_MENTIONS(verdict(2, [](AgentPlan& m) { m.path.insert(m.path.begin(), m.path.front()); }),
                  "agent 'm' finishes at time 3, but the plan claims 2");
}

TEST(Check, RefusesAWrongStart) {
  EXPECT_MENTIONS(verdict(1, [](AgentPlan& b) { b.path.front() = at(4, 2); }),
                  "/agents/1/path/0: agent 'b' begins on [4, 2]; expected its start [4, 1]");
}

TEST(Check, RefusesAWrongEnd) {
  EXPECT_MENTIONS(verdict(1, [](AgentPlan& b) { b.path.pop_back(); }),
                  "/agents/1/path/4: agent 'b' ends on [1, 2]; expected its goal [0, 2]");
  EXPECT_MENTIONS(verdict(2, [](AgentPlan& m) { m.path.push_back(at(0, 1)); }),
                  "/agents/2/path/3: agent 'm' ends on [0, 1]; expected one of its own tasks");
}

TEST(Check, RefusesJumps) {
  EXPECT_MENTIONS(verdict(0, [](AgentPlan& a) { a.path.erase(a.path.begin() + 1); }),
                  "/agents/0/path/1: agent 'a' jumps from [0, 0] to [2, 0]");
  // From the right edge to the left edge of the next row: the cell numbers are consecutive, but the
  // cells are not adjacent.
  EXPECT_MENTIONS(verdict(1,
                          [](AgentPlan& b) {
                            b.path = {at(4, 1), at(0, 2)};
                          }),
                  "jumps from [4, 1] to [0, 2]");
  // A diagonal move.
  EXPECT_MENTIONS(verdict(2, [](AgentPlan& m) { m.path[1] = at(1, 0); }),
                  "jumps from [0, 1] to [1, 0]");
}

TEST(Check, RefusesBlockedCellsAndCellsOutside) {
  EXPECT_MENTIONS(verdict(0, [](AgentPlan& a) { a.path[1] = at(1, 1); }),
                  "/agents/0/path/1: agent 'a' is on the blocked cell [1, 1]");
  EXPECT_MENTIONS(verdict(0, [](AgentPlan& a) { a.path[1] = 15; }),
                  "/agents/0/path/1: agent 'a' is outside the map");
  EXPECT_MENTIONS(verdict(0, [](AgentPlan& a) { a.path[1] = kNoCell; }),
                  "/agents/0/path/1: agent 'a' is outside the map");
}

TEST(Check, RefusesMissedTasks) {
  EXPECT_MENTIONS(verdict(0,
                          [](AgentPlan& a) {
                            a.path.resize(5);  // ends at its goal before t1
                            a.cost = 4;
                          }),
                  "/agents/0/path: agent 'a' never visits its task 't1' on [4, 2]");
}

TEST(Check, RefusesAWrongSequence) {
  const auto with = [](std::vector<TaskIndex> sequence) {
    return verdict(0, [&](AgentPlan& a) { a.sequence = std::move(sequence); });
  };
  const auto expected = [](const std::string& what) {
    return "/agents/0/sequence: " + what + "; expected every task of agent 'a' exactly once";
  };
  EXPECT_EQ(with({}), expected("task 't0' is missing"));
  EXPECT_EQ(with({0}), expected("task 't1' is missing"));
  EXPECT_EQ(with({0, 0}), expected("task 't0' is repeated"));
  EXPECT_EQ(with({0, 1, 2}), expected("task 't2' does not list the agent"));
  EXPECT_EQ(with({0, 99}), expected("there is no task 99"));
  EXPECT_EQ(with({1, 0}),
            "/agents/0/sequence/1: the path of agent 'a' does not visit task 't0' in this order");
}

TEST(Check, AcceptsEndOfMgAgentOnlyOnItsLastTask) {
  InstanceBuilder builder(Grid(3, 1, std::vector<bool>(3, true)));
  builder.add_agent("m", {1, 0}, std::nullopt);
  builder.add_task("left", {0, 0}, Ids{"m"});
  builder.add_task("right", {2, 0}, Ids{"m"});
  const Instance two_tasks = std::move(builder).build();
  Solution solution;
  solution.status = Status::kOptimal;
  solution.plan = Plan{5, {{5, {1, 0}, {1, 0, 1, 2, 1, 0}}}};
  solution.lower_bound = 5;
  EXPECT_TRUE(check(two_tasks, solution).empty());
  solution.plan->agents[0].sequence = {0, 1};
  const auto violations = check(two_tasks, solution);
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].json_pointer, "/agents/0/sequence/1");
}

// Returns the violation of a plan for two agents on a 4 x 2 map without tasks; "" if it is valid.
// Each path starts at its agent's start and ends at its destination.
std::string collision(const Path& first, const Path& second) {
  InstanceBuilder builder(Grid(4, 2, std::vector<bool>(8, true)));
  const Grid grid(4, 2, std::vector<bool>(8, true));
  builder.add_agent("p", grid.position(first.front()), grid.position(first.back()));
  builder.add_agent("q", grid.position(second.front()), grid.position(second.back()));
  const Instance two = std::move(builder).build();
  const auto cost = [](const Path& path) { return static_cast<Time>(path.size()) - 1; };
  Solution solution;
  solution.lower_bound = cost(first) + cost(second);
  solution.plan =
      Plan{solution.lower_bound, {{cost(first), {}, first}, {cost(second), {}, second}}};
  solution.status = Status::kOptimal;
  const auto violations = check(two, solution);
  EXPECT_LE(violations.size(), 1U);
  return violations.empty() ? "" : violations[0].json_pointer + ": " + violations[0].message;
}

// 0 1 2 3
// 4 5 6 7
TEST(Check, FindsVertexConflicts) {
  EXPECT_EQ(collision({0, 1, 2}, {5, 1, 0}),
            "/agents/1/path/1: agents 'p' and 'q' are both on [1, 0] at time 1");
}

TEST(Check, FindsConflictsWithRestingAgents) {
  EXPECT_EQ(collision({0, 1}, {3, 2, 1, 5}),
            "/agents/1/path/2: agents 'p' and 'q' are both on [1, 0] at time 2");
  EXPECT_EQ(collision({3, 2, 1, 5}, {0, 1}),
            "/agents/1/path/1: agents 'p' and 'q' are both on [1, 0] at time 2");
}

TEST(Check, FindsEdgeConflicts) {
  EXPECT_EQ(collision({0, 1, 2, 3}, {3, 2, 1, 0}),
            "/agents/0/path/2: agents 'p' and 'q' swap [1, 0] and [2, 0] between times 1 and 2");
  EXPECT_EQ(collision({0, 1}, {1, 0}),
            "/agents/0/path/1: agents 'p' and 'q' swap [0, 0] and [1, 0] between times 0 and 1");
}

TEST(Check, AcceptsFollowingAndRotation) {
  EXPECT_EQ(collision({1, 2}, {0, 1}), "");
  EXPECT_EQ(collision({0, 1, 5}, {5, 4, 0}), "");
}

TEST(Check, ReportsEachPairOfAgentsOnce) {
  EXPECT_EQ(collision({0, 0, 0, 0, 1}, {4, 0, 0, 0, 4, 0}),
            "/agents/1/path/1: agents 'p' and 'q' are both on [0, 0] at time 1");
}

TEST(Check, StopsAtTheLimit) {
  Solution solution = valid_solution();
  for (AgentPlan& agent : solution.plan->agents) agent.path.clear();
  EXPECT_EQ(check(instance(), solution, 2).size(), 2U);
  EXPECT_EQ(check(instance(), solution).size(), 3U);
}

TEST(Check, PlanOfSearchMustBeValid) {
  const Plan plan = *valid_solution().plan;
  EXPECT_EQ(checked_plan(instance(), plan).cost, 15);
  EXPECT_NO_THROW(require_valid_plan(instance(), plan));
  Plan wrong = plan;
  wrong.cost -= 1;
  EXPECT_THROW(require_valid_plan(instance(), wrong), InvalidPlan);
  try {
    checked_plan(instance(), wrong);
    ADD_FAILURE() << "no exception";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(),
                 "internal error: a plan of the search is wrong at /cost: the agents' costs add up "
                 "to 15, but the plan claims 14");
  }
}

}  // namespace check_test
}  // namespace grove::detail
