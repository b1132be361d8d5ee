// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace check_command_test {

// . . .   a: from (0, 0) to (2, 0); b: from (2, 1) via task t (1, 1) to (0, 1).
// . . .
class CheckCommand : public ::testing::Test {
 protected:
  CheckCommand() {
    directory_.write("m.map", "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
    directory_.write("m.scen",
                     "version 1\n0\tm.map\t3\t2\t0\t0\t2\t0\t2\n0\tm.map\t3\t2\t2\t1\t0\t1\t2\n");
    directory_.write("i.json",
                     R"({"map": "m.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]},
      {"id": "b", "start": [2, 1], "goal": [0, 1]}], "tasks": [{"id": "t", "cell": [1, 1], "agents": ["b"]}]})");
  }

  // Checks a plan with the given claims and agents, both in JSON.
  ProcessResult check(const std::string& claims, const std::string& agents) const {
    directory_.write("p.json", "{" + claims + ", \"agents\": [" + agents + "]}");
    return run_grove({"check", directory_ / "i.json", directory_ / "p.json"});
  }
  // Returns the text on stderr, without the directory.
  std::string said(const ProcessResult& result) const {
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    const std::string folder = directory_.path().string() + "/";
    std::string text = result.err;
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    return text;
  }

  TemporaryDirectory directory_;
};

const std::string kClaims = R"("status": "bounded", "cost": 4, "lower_bound": 3, "omega": 0.5)";
const std::string kAgentA =
    R"({"id": "a", "sequence": [], "cost": 2, "path": [[0,0],[1,0],[2,0]]})";
const std::string kAgentB =
    R"({"id": "b", "sequence": ["t"], "cost": 2, "path": [[2,1],[1,1],[0,1]]})";

TEST_F(CheckCommand, AcceptsAValidPlan) {
  const ProcessResult result = check(kClaims, kAgentA + ", " + kAgentB);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "valid: cost 4, lower bound 3, gap 33.33 %, 2 agents\n");
  EXPECT_EQ(result.err, "");
}

TEST_F(CheckCommand, AcceptsAPlanForAScenario) {
  directory_.write("p.json",
                   R"({"status": "optimal", "cost": 4, "lower_bound": 4, "omega": "inf", "agents": [
    {"id": "a0", "sequence": [], "cost": 2, "path": [[0,0],[1,0],[2,0]]},
    {"id": "a1", "sequence": [], "cost": 2, "path": [[2,1],[1,1],[0,1]]}]})");
  const ProcessResult result =
      run_grove({"check", directory_ / "m.scen", "--map", directory_ / "m.map", "--agents", "2",
                 directory_ / "p.json"});
  EXPECT_EQ(result.out, "valid: cost 4, lower bound 4, gap 0.00 %, 2 agents\n") << result.err;
}

TEST_F(CheckCommand, PrintsEachViolationOnItsOwnLine) {
  const std::string collides =
      R"({"id": "b", "sequence": [], "cost": 3, "path": [[2,1],[1,1],[1,0],[0,1]]})";
  EXPECT_EQ(
      said(check(kClaims, kAgentA + ", " + collides)),
      "p.json: /agents/1/path/3: agent 'b' jumps from [1, 0] to [0, 1]; expected a wait or a "
      "move to one of 4 neighbors\n"
      "p.json: /agents/1/sequence: task 't' is missing; expected every task of agent 'b' exactly "
      "once\n"
      "p.json: /cost: the agents' costs add up to 5, but the plan claims 4\n"
      "p.json: /status: found 'bounded'; expected 'feasible' with cost 5, lower bound 3 and "
      "omega 0.5\n");
}

TEST_F(CheckCommand, PointersReferToTheOrderOfThePlanFile) {
  const std::string wrong = R"({"id": "b", "sequence": ["t"], "cost": 1, "path": [[2,1],[0,1]]})";
  const ProcessResult result = check(kClaims, wrong + ", " + kAgentA);
  EXPECT_NE(said(result).find("p.json: /agents/0/path/1: agent 'b' jumps"), std::string::npos)
      << result.err;
  EXPECT_EQ(result.err.find("/agents/1"), std::string::npos) << result.err;
}

TEST_F(CheckCommand, RejectsEmptyAndPartialPlans) {
  EXPECT_EQ(said(check(kClaims, kAgentA)),
            "p.json: /agents: agent 'b' has no path; expected one for every agent\n");
  EXPECT_EQ(said(check(R"("status": "optimal", "cost": 0, "lower_bound": 0, "omega": 0)", "")),
            "p.json: /agents/0: agent 'a' has no path; expected one for every agent\n"
            "p.json: /agents/1: agent 'b' has no path; expected one for every agent\n");
  directory_.write("p.json", R"({"status": "unknown", "lower_bound": 3, "omega": 0})");
  EXPECT_EQ(said(run_grove({"check", directory_ / "i.json", directory_ / "p.json"})),
            "p.json: /status: there is no plan ('unknown'); expected a path for every agent\n");
}

TEST_F(CheckCommand, RefusesAPlanForAnotherInstance) {
  EXPECT_EQ(said(check(kClaims, R"({"id": "z", "sequence": [], "cost": 0, "path": []})")),
            "grove: error: p.json: /agents/0/id: there is no agent 'z' in the instance; expected "
            "the id of one of its agents\n");
}

// Path lists of other solvers make no claims. The command checks only the paths, and its output
// says so.
TEST_F(CheckCommand, ChecksBarePathLists) {
  directory_.write("paths.txt", "Agent 0: (0,0)->(0,1)->(0,2)->\nAgent 1: (1,2)->(1,1)->(1,0)->\n");
  EXPECT_EQ(run_grove({"check", directory_ / "i.json", directory_ / "paths.txt"}).out,
            "valid: cost 4, 2 agents; not claimed and not checked: cost, lower bound, order of "
            "tasks\n");
  ProcessOptions options;
  options.input = "Agent 0: (0,0)->(0,1)\nAgent 1: (1,2)->(1,1)->(1,0)\n";
  EXPECT_NE(said(run_grove({"check", directory_ / "i.json", "-"}, options)).find("agent 'a' ends"),
            std::string::npos);
  const std::string paths = "solution=\n0:(0,0),(2,1),\n1:(1,0),(1,1),\n2:(2,0),(0,1),\n";
  const auto check_text = [&](const std::string& claims) {
    return run_grove({"check", directory_ / "m.scen", "--map", directory_ / "m.map", "--agents",
                      "2", directory_.write("text", claims + paths)});
  };
  EXPECT_EQ(check_text("soc=4\nsoc_lb=4\n").out,
            "valid: cost 4, lower bound 4, gap 0.00 %, 2 agents\n");
  EXPECT_EQ(said(check_text("soc=3\n")),
            "text: /cost: the agents' costs add up to 4, but the plan claims 3\n");
}

TEST_F(CheckCommand, RefusesUnknownKeys) {
  const ProcessResult result = check(kClaims + ", \"note\": 1", kAgentA + ", " + kAgentB);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("p.json: /: unknown key 'note'; expected one of status,"),
            std::string::npos);
}

TEST_F(CheckCommand, ReportsSwappedArguments) {
  check(kClaims, kAgentA + ", " + kAgentB);  // writes both files
  const ProcessResult result = run_grove({"check", directory_ / "p.json", directory_ / "i.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(said(result),
            "grove: error: p.json: found a plan; expected an instance before its plan: "
            "'grove check INSTANCE PLAN'\n");
}

}  // namespace check_command_test
}  // namespace grove::detail
