// SPDX-License-Identifier: MIT
#include "io/plan_import.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "io/input_error.h"
#include "io/plan_export.h"
#include "io/plan_file.h"
#include "model/check.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace plan_import_test {

using Words = std::vector<std::string>;

// . @ . .   Wider than high, and without symmetries.
// . . . .
// . . . @
class PlanImport : public ::testing::Test {
 protected:
  ClaimedPlan read(const std::string& text, const Instance& instance) {
    return read_plan_of_any_tool(directory_.write("plan", text), instance);
  }
  ClaimedPlan read(const std::string& text) { return read(text, mapf_); }
  // Returns the first violation, or "" if the plan is valid.
  std::string first_violation(const std::string& text) {
    const auto violations = check(mapf_, read(text).solution);
    return violations.empty() ? "" : violations[0].json_pointer + ": " + violations[0].message;
  }
  std::string refused(const std::string& text) {
    return refusal([&] { read(text); });
  }

  const Instance mapf_ = testing::instance_of({".@..", "....", "...@"},
                                              {{{0, 0}, Position{3, 0}}, {{2, 2}, Position{0, 1}}});
  TemporaryDirectory directory_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

// Paths of cells (row,column), as EECBS writes them. LNS2 writes no space after the colon, as in
// the second line.
const std::string kLists =
    "Agent 0: (0,0)->(0,0)->(1,0)->(1,1)->(1,2)->(1,3)->(0,3)->\n"
    "Agent 1:(2,2)->(2,1)->(2,0)->(2,0)->(1,0)->\n";
// A plan as lacam3 writes it, with cells (x,y).
const std::string kText =
    "agents=2\nmap_file=m.map\nsolver=planner\nsolved=1\nsoc=10\nsoc_lb=8\nmakespan=6\n"
    "comp_time=1.5\nseed=0\nstarts=(0,0),(2,2),\ngoals=(3,0),(0,1),\nsolution=\n"
    "0:(0,0),(2,2),\n1:(0,0),(1,2),\n2:(0,1),(0,2),\n3:(1,1),(0,2),\n4:(2,1),(0,1),\n"
    "5:(3,1),(0,1),\n6:(3,0),(0,1),\n";

TEST_F(PlanImport, ReadsPathLists) {
  const ClaimedPlan plan = read(kLists);
  EXPECT_EQ(check(mapf_, plan.solution).size(), 0u);
  EXPECT_EQ(plan.solution.plan->cost, 10);
  EXPECT_EQ(plan.solution.plan->agents[1].cost, 4);
  EXPECT_EQ(plan.unclaimed, (Words{"cost", "lower bound"}));
}

// Lazy CBS separates the cells by blanks.
TEST_F(PlanImport, ReadsPathListsWithBlanks) {
  std::string text = kLists;
  for (std::size_t at = text.find("->"); at != std::string::npos; at = text.find("->"))
    text.replace(at, 2, text[at + 2] == '\n' ? "" : " ");
  const ClaimedPlan plan = read(text);
  EXPECT_EQ(check(mapf_, plan.solution).size(), 0u);
  EXPECT_EQ(plan.solution.plan->cost, 10);
}

TEST_F(PlanImport, ReadsTheTextOfLacam) {
  const ClaimedPlan plan = read(kText);
  EXPECT_EQ(check(mapf_, plan.solution).size(), 0u);
  EXPECT_EQ(plan.solution.plan->cost, 10);
  EXPECT_EQ(plan.solution.lower_bound, 8);
  EXPECT_EQ(plan.unclaimed, Words());
  const ClaimedPlan bare = read(kText.substr(kText.find("solution=")));
  EXPECT_EQ(check(mapf_, bare.solution).size(), 0u);
  EXPECT_EQ(bare.unclaimed, (Words{"cost", "lower bound"}));
}

TEST_F(PlanImport, ReadsPlanFiles) {
  const Solution solution = read(kText).solution;
  write_solution(directory_ / "plan.json", mapf_, solution);
  const ClaimedPlan plan = read_plan_of_any_tool(directory_ / "plan.json", mapf_);
  EXPECT_EQ(plan.solution.plan->agents[0].path, solution.plan->agents[0].path);
  EXPECT_EQ(plan.unclaimed, Words());
}

// A schedule with the keys x and y. ITA-CBS2 names agents by number, MGCBS by name.
const std::string kSchedule =
    "statistics:\n  cost: 10\n  runtime: 0.1\nschedule:\n"
    "  agent0:\n    - x: 0\n      y: 0\n      t: 0\n    - {x: 0, y: 0, t: 1}\n"
    "    - {x: 0, y: 1, t: 2}\n    - {x: 1, y: 1, t: 3}\n    - {x: 2, y: 1, t: 4}\n"
    "    - {x: 3, y: 1, t: 5}\n    - {x: 3, y: 0, t: 6}\n"
    "  a1:\n    - {x: 2, y: 2, t: 0}\n    - {x: 1, y: 2, t: 1}\n    - {x: 0, y: 2, t: 2}\n"
    "    - {x: 0, y: 2, t: 3}\n    - {x: 0, y: 1, t: 4}\n    - {x: 0, y: 1, t: 5}\n";

TEST_F(PlanImport, ReadsSchedules) {
  const ClaimedPlan plan = read(kSchedule);
  EXPECT_EQ(check(mapf_, plan.solution).size(), 0u);
  EXPECT_EQ(plan.solution.plan->cost, 10);
  EXPECT_EQ(plan.solution.plan->agents[1].cost, 4);
  EXPECT_EQ(plan.unclaimed, Words{"lower bound"});
  EXPECT_EQ(read(kSchedule.substr(kSchedule.find("schedule:"))).unclaimed,
            (Words{"cost", "lower bound"}));
  EXPECT_FALSE(read("statistics:\n  cost: 3\nschedule:\n").solution.plan);
}

TEST_F(PlanImport, RefusesInvalidSchedulesWithThePlace) {
  EXPECT_EQ(refused(replaced(kSchedule, "agent0", "agent2")),
            "plan: line 5, column 3: found 'agent2', which is not an agent of the instance; "
            "expected the name of an agent, or agent0 to agent1");
  EXPECT_EQ(refused(replaced(kSchedule, "  a1:", "  a0:")),
            "plan: line 15, column 3: an agent appears more than once");
  EXPECT_EQ(refused(replaced(kSchedule, "x: 3, y: 0, t: 6", "x: 3, y: 0, t: 7")),
            "plan: line 14, column 23: expected t: 6, because steps are consecutive");
  EXPECT_NE(refused(replaced(kSchedule, "x: 3, y: 0", "x: 4, y: 0")), "accepted");
  EXPECT_NE(refused(replaced(kSchedule, "x: 3, y: 0", "x: 3, y: -1")), "accepted");
  EXPECT_NE(refused(replaced(kSchedule, "x: 3, ", "")), "accepted");
  EXPECT_NE(refused(replaced(kSchedule, "  cost: 10", "  cost: ten")), "accepted");
}

// Costs are computed from the paths, whatever the file claims.
TEST_F(PlanImport, RecomputesCosts) {
  const auto recounted = [&](const std::string& text) {
    return read_and_recount(directory_.write("plan", text), mapf_);
  };
  const RecountedPlan false_claim = recounted(replaced(kText, "soc=10", "soc=7"));
  EXPECT_EQ(false_claim.solution.plan->cost, 10);
  EXPECT_EQ(false_claim.solution.lower_bound, 0);
  EXPECT_EQ(false_claim.claimed_cost, 7);
  EXPECT_EQ(false_claim.claimed_lower_bound, 8);
  EXPECT_EQ(check(mapf_, false_claim.solution).size(), 0u);
  EXPECT_EQ(recounted(kLists).claimed_cost, std::nullopt);
  EXPECT_EQ(recounted(kSchedule).claimed_cost, 10);
  EXPECT_FALSE(recounted(replaced(kText, "solved=1", "solved=0")).solution.plan);
  // The bound of an imported plan is only an unchecked claim, too.
  Solution solution = read(kText).solution;
  solution.status = Status::kOptimal;
  solution.lower_bound = 10;
  write_solution(directory_ / "plan.json", mapf_, solution);
  const RecountedPlan file = read_and_recount(directory_ / "plan.json", mapf_);
  EXPECT_EQ(file.claimed_lower_bound, 10);
  EXPECT_EQ(file.solution.lower_bound, 0);
  EXPECT_EQ(file.solution.status, Status::kFeasible);
}

// An exported plan can be imported; the order of tasks is derived from the paths.
TEST_F(PlanImport, DerivesTheOrderOfTasks) {
  InstanceBuilder builder(testing::grid_of({"....", "...."}));
  builder.add_agent("to", {0, 0}, Position{3, 1});
  builder.add_agent("free", {3, 0}, std::nullopt);
  builder.add_task("late", {2, 0}, Words{"to", "free"});
  builder.add_task("early", {1, 0}, Words{"to"});
  builder.add_task("end", {2, 1}, Words{"free"});
  const Instance instance = std::move(builder).build();
  const auto path = [&](const std::vector<Position>& positions) {
    Path cells;
    for (const Position p : positions) cells.push_back(instance.grid().cell(p));
    return cells;
  };
  Solution solution;
  solution.omega = Omega::infinite();
  solution.status = Status::kFeasible;
  // Agent "free" passes the task on which it later ends.
  solution.plan =
      Plan{12,
           {{6, {1, 0}, path({{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}, {3, 0}, {3, 1}})},
            {6, {0, 2}, path({{3, 0}, {3, 1}, {2, 1}, {2, 0}, {2, 1}, {1, 1}, {2, 1}})}}};
  ASSERT_EQ(check(instance, solution).size(), 0u);
  write_path_lists(directory_ / "lists", instance, solution);
  write_visualizer_text(directory_ / "text", instance, solution, "m.map");
  for (const char* name : {"lists", "text"}) {
    const ClaimedPlan plan = read_plan_of_any_tool(directory_ / name, instance);
    EXPECT_EQ(check(instance, plan.solution).size(), 0u);
    EXPECT_EQ(plan.solution.plan->agents[0].sequence, (std::vector<TaskIndex>{1, 0}));
    EXPECT_EQ(plan.solution.plan->agents[1].sequence, (std::vector<TaskIndex>{0, 2}));
    EXPECT_EQ(plan.unclaimed.back(), "order of tasks");
  }
}

TEST_F(PlanImport, LeavesFalseClaimsToTheChecker) {
  EXPECT_EQ(first_violation(replaced(kText, "soc=10", "soc=9")),
            "/cost: the agents' costs add up to 10, but the plan claims 9");
  EXPECT_EQ(first_violation(replaced(kText, "soc_lb=8", "soc_lb=11")),
            "/lower_bound: found 11; expected at most 10, the cost of this plan");
  EXPECT_EQ(
      first_violation(replaced(kLists, "(1,1)->", "")),
      "/agents/0/path/3: agent 'a0' jumps from [0, 1] to [2, 1]; expected a wait or a move to "
      "one of 4 neighbors");
  EXPECT_NE(first_violation(replaced(kLists, "->(0,3)", "")).find("expected its goal"),
            std::string::npos);
  EXPECT_NE(
      first_violation(kLists.substr(0, kLists.find("Agent 1"))).find("agent 'a1' has no path"),
      std::string::npos);
  EXPECT_NE(first_violation(replaced(kText, "(0,2),\n3:(1,1),(0,2)", "(1,2),\n3:(1,1),(1,1)"))
                .find("both on"),
            std::string::npos);
}

TEST_F(PlanImport, ReadsFilesWithoutAPlan) {
  for (const std::string& text :
       {replaced(kText, "solved=1", "solved=0"), kText.substr(0, kText.find("solution="))})
    EXPECT_FALSE(read(text).solution.plan);
}

TEST_F(PlanImport, RefusesInvalidFilesWithThePlace) {
  EXPECT_EQ(refused(replaced(kLists, "Agent 1", "Agent 2")),
            "plan: line 2, column 8: there is no agent 2 in the instance; expected less than 2");
  EXPECT_EQ(refused(replaced(kLists, "Agent 1", "Agent 0")),
            "plan: line 2, column 8: agent 0 appears twice");
  EXPECT_EQ(
      refused(replaced(kLists, "(1,3)", "(3,1)")),
      "plan: line 1, column 45: column 1, row 3 is outside the map, which has 4 columns and 3 "
      "rows");
  EXPECT_EQ(refused(replaced(kLists, "->(1,1)", "->(1,1,3)")),
            "plan: line 1, column 35: expected ')'");
  EXPECT_EQ(refused(replaced(kLists, "->(1,1)", "-(1,1)")),
            "plan: line 1, column 29: expected '->'");
  EXPECT_EQ(refused(replaced(kText, "agents=2", "agents=3")),
            "plan: line 1, column 9: expected 2 agents, as in the instance");
  EXPECT_EQ(refused(replaced(kText, "\n4:", "\n5:")), "plan: line 17, column 1: expected '4:'");
  EXPECT_EQ(refused(replaced(kText, "4:(2,1),(0,1),", "4:(2,1),(0,1),(1,1),")),
            "plan: line 17, column 15: expected the end of the line, after all agents of the "
            "instance");
  EXPECT_EQ(refused(replaced(kText, "soc=10", "soc=-1")),
            "plan: line 5, column 5: expected an integer of at least 0");
  for (const char* text : {"a,b\n1,2\n", "cost 7"})
    EXPECT_EQ(
        refused(text),
        "plan: line 1: expected a plan file (JSON), paths as 'Agent 0: (row,column)->', the text "
        "of lacam, with 'solution=', or YAML with 'schedule:'");
  EXPECT_EQ(refused("\n"), "plan: is empty; expected a JSON object");
  EXPECT_EQ(refused(" [1]"), "plan: /: found an array; expected a JSON object");
}

// Reading a damaged file either yields a plan or is refused.
TEST_F(PlanImport, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(1);
  int accepted = 0;
  const int rounds = testing::fuzz_rounds(1000);
  for (int round = 0; round < rounds; ++round) {
    std::string text = std::array{kLists, kText, kSchedule}[round % 3];
    for (int k = 0; k < 2; ++k)
      text[random() % text.size()] = "0123456789(),->:= \nA\xff"[random() % 22];
    SCOPED_TRACE(text);
    try {
      const ClaimedPlan plan = read(text);
      check(mapf_, plan.solution);
      ++accepted;
    } catch (const InputError&) {
      continue;
    }
  }
  EXPECT_GT(accepted, rounds / 50);
}

}  // namespace plan_import_test
}  // namespace grove::detail
