// SPDX-License-Identifier: MIT
// Tests that commands support or refuse instances in which agents choose tasks or destinations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace choices_commands_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kGoals = "agent 'a' has a choice of goals, which ";
const std::string kGoalsEnd = "; expected 'goal'";
const std::string kNeed = "task 't' has a choice of agents, which ";
const std::string kNeedEnd = "; expected no 'need' below the number of its agents";

class ChoicesCommands : public ::testing::Test {
 protected:
  ChoicesCommands() {
    directory_.write("m.map", "type octile\nheight 1\nwidth 5\nmap\n.....\n");
    directory_.write("goals.cts.json", R"({"map": "m.map", "tasks": [], "agents": [
      {"id": "a", "start": [1, 0], "goals": [[0, 0], [2, 0]]},
      {"id": "b", "start": [3, 0], "goal": [4, 0]}]})");
    directory_.write("need.cts.json", R"({"map": "m.map", "agents": [
      {"id": "a", "start": [1, 0], "goal": [0, 0]}, {"id": "b", "start": [3, 0], "goal": [4, 0]}],
      "tasks": [{"id": "t", "cell": [2, 0], "agents": "*", "need": 1}]})");
    directory_.write("goals.plan.json", R"({"status": "optimal", "cost": 2, "lower_bound": 2,
      "omega": 0, "agents": [{"id": "a", "sequence": [], "cost": 1, "path": [[1, 0], [0, 0]]},
      {"id": "b", "sequence": [], "cost": 1, "path": [[3, 0], [4, 0]]}]})");
    directory_.write("need.plan.json", R"({"status": "optimal", "cost": 4, "lower_bound": 4,
      "omega": 0, "agents": [{"id": "a", "sequence": [], "cost": 1, "path": [[1, 0], [0, 0]]},
      {"id": "b", "sequence": ["t"], "cost": 3, "work": [{"task": "t", "begin": 1, "end": 1}],
       "path": [[3, 0], [2, 0], [3, 0], [4, 0]]}]})");
  }

  ProcessResult run(const std::vector<std::string>& words) const {
    return run_grove(words, {.directory = directory_.path()});
  }
  std::string refused(const std::vector<std::string>& words) const { return complaint(run(words)); }
  std::string read(const std::string& name) const {
    std::ifstream file(directory_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
      names.push_back(entry.path().filename());
    return names;
  }

  TemporaryDirectory directory_;
};

TEST_F(ChoicesCommands, SolveFindsValidPlans) {
  for (const std::string name : {"goals", "need"})
    for (const std::string policy : {"free", "fixed"}) {
      const ProcessResult solved = run({"solve", name + ".cts.json", "--output", "x.plan.json",
                                        "--omega", "0", "--policy", policy});
      EXPECT_EQ(solved.exit_code, 0) << solved.err;
      EXPECT_EQ(run({"check", name + ".cts.json", "x.plan.json"}).exit_code, 0);
      std::filesystem::remove(directory_.path() / "x.plan.json");
    }
}

TEST_F(ChoicesCommands, SolveRefusesWhatDoesNotSupportChoices) {
  const std::size_t before = files().size();
  const std::vector<std::vector<std::string>> cases{
      {"checkpoints do not support", "--checkpoint", "state"},
      {"method mgcbs does not support", "--method", "mgcbs"},
      {"method cts-cbs-b does not support", "--method", "cts-cbs-b"},
      {"a start plan does not support", "--start"}};
  for (const auto& each : cases) {
    for (const std::string name : {"goals", "need"}) {
      std::vector<std::string> words{"solve", name + ".cts.json", "--output", "x.plan.json"};
      words.insert(words.end(), each.begin() + 1, each.end());
      if (each.back() == "--start") words.push_back(name + ".plan.json");
      const bool is_need = name == "need";
      const std::string place =
          name + ".cts.json: /" + (is_need ? "tasks/0/need: " : "agents/0/goals: ");
      const std::string text = refused(words);
      EXPECT_THAT(text, StartsWith(place + (is_need ? kNeed : kGoals) + each[0] + "; expected "));
      EXPECT_THAT(text,
                  EndsWith((is_need ? kNeedEnd : kGoalsEnd).substr(sizeof("; expected ") - 1)));
    }
  }
  EXPECT_EQ(files().size(), before);
}

TEST_F(ChoicesCommands, SolveWritesCertificates) {
  for (const std::string name : {"goals", "need"}) {
    const ProcessResult solved =
        run({"solve", name + ".cts.json", "--output", "x.plan.json", "--proof", "p.proof"});
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    EXPECT_TRUE(std::filesystem::exists(directory_.path() / "p.proof"));
    std::filesystem::remove(directory_.path() / "x.plan.json");
  }
}

TEST_F(ChoicesCommands, SolveRefusesCertificatesThatNoRuleCovers) {
  directory_.write("turns.cts.json", R"({"map": "m.map", "tasks": [], "agents": [
      {"id": "a", "start": [1, 0], "goals": [[0, 0], [2, 0]], "motion": "turning", "heading": "E"}]})");
  EXPECT_EQ(refused({"solve", "turns.cts.json", "--output", "x.plan.json", "--proof", "p.proof"}),
            "turns.cts.json: /agents/0: agent 'a' has a choice and needs time to turn, which "
            "proofs do not support; expected no proof, or agents that turn freely");
  EXPECT_FALSE(std::filesystem::exists(directory_ / "p.proof"));
}

TEST_F(ChoicesCommands, CheckVerifiesPlans) {
  EXPECT_EQ(run({"check", "goals.cts.json", "goals.plan.json"}).out,
            "valid: cost 2, lower bound 2, gap 0.00 %, 2 agents\n");
  EXPECT_EQ(run({"check", "need.cts.json", "need.plan.json"}).out,
            "valid: cost 4, lower bound 4, gap 0.00 %, 2 agents\n");
  directory_.write("paths", "Agent 0: (0,1)->(0,0)->\nAgent 1: (0,3)->(0,2)->(0,3)->(0,4)->\n");
  EXPECT_EQ(refused({"check", "need.cts.json", "paths"}),
            "paths: line 1: expected a plan file (JSON), since task 't' of the instance has a "
            "choice of agents, and other formats do not state who visits it");
  EXPECT_EQ(run({"check", "goals.cts.json", "paths"}).exit_code, 0);
}

TEST_F(ChoicesCommands, ReplanChoosesAgain) {
  for (const std::string name : {"goals", "need"}) {
    const ProcessResult done = run({"replan", name + ".cts.json", name + ".plan.json", "--at", "1",
                                    "--quiet", "-o", "then.plan.json"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(run({"check", "then.cts.json", "then.plan.json"}).exit_code, 0);
  }
  // b has visited the task at time 1.
  EXPECT_THAT(read("then.cts.json"), HasSubstr("\"tasks\": []"));
}

TEST_F(ChoicesCommands, ReplanAddsTasksWithANeed) {
  directory_.write("new.json", R"({"id": "n", "cell": [3, 0], "agents": "*", "need": 1})");
  const ProcessResult done = run({"replan", "need.cts.json", "need.plan.json", "--at", "0",
                                  "--new-task", "new.json", "--quiet", "-o", "then.plan.json"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(run({"check", "then.cts.json", "then.plan.json"}).out.substr(0, 14), "valid: cost 4,");
  directory_.write("all.json", R"({"id": "n", "cell": [3, 0], "agents": "*"})");
  EXPECT_EQ(
      run({"replan", "need.cts.json", "need.plan.json", "--at", "0", "--new-task", "all.json", "-o",
           "all.plan.json"})
          .err,
      "grove: hint: all.json: \"agents\": \"*\" without \"need\" means that all 2 agents must "
      "visit the task; if any one of them may do so, add \"need\": 1\n");
  directory_.write("bad.json", R"({"id": "n", "cell": [3, 0], "agents": ["a"], "need": 2})");
  EXPECT_EQ(
      refused({"replan", "need.cts.json", "need.plan.json", "--at", "0", "--new-task", "bad.json",
               "-o", "x.plan.json"}),
      "bad.json: /need: found 2; expected an integer from 1 to 1, the number of agents of the "
      "task");
}

TEST_F(ChoicesCommands, ExecuteRefuses) {
  const std::string reason =
      "passing orders do not support; expected an instance of 'grove convert --fix-choices', or ";
  EXPECT_EQ(refused({"execute", "goals.cts.json", "goals.plan.json", "--order", "o.json"}),
            "goals.cts.json: /agents/0/goals: " + kGoals + reason + "'goal'");
  EXPECT_EQ(refused({"execute", "need.cts.json", "need.plan.json", "--order", "o.json"}),
            "need.cts.json: /tasks/0/need: " + kNeed + reason +
                "no 'need' below the number of its agents");
  EXPECT_FALSE(std::filesystem::exists(directory_ / "o.json"));
}

TEST_F(ChoicesCommands, ViewRefusesADrive) {
  directory_.write("d.jsonl", "");
  const std::string reason =
      "--drive does not support; expected an instance of "
      "'grove convert --fix-choices', or ";
  const auto refused_drive = [&](const std::string& name) {
    return refused({"view", name + ".cts.json", name + ".plan.json", "--drive", "d.jsonl"});
  };
  EXPECT_THAT(refused_drive("goals"),
              StartsWith("goals.cts.json: /agents/0/goals: " + kGoals + reason));
  EXPECT_THAT(refused_drive("need"), StartsWith("need.cts.json: /tasks/0/need: " + kNeed + reason));
}

// All but --quiet: the hint is one line, and the command does its work.
TEST_F(ChoicesCommands, SolveAndCheckHintAtTasksForAllAgents) {
  directory_.write("all.cts.json", R"({"map": "m.map", "agents": [
      {"id": "a", "start": [1, 0], "goal": [1, 0]}, {"id": "b", "start": [3, 0], "goal": [3, 0]}],
      "tasks": [{"id": "t", "cell": [2, 0], "agents": "*"}]})");
  const std::string hint =
      "grove: hint: all.cts.json: /tasks/0: \"agents\": \"*\" without \"need\" means that all 2 "
      "agents "
      "must visit the task; if any one of them may do so, add \"need\": 1\n";
  const auto solve = [&](const char* option) {
    return run({"solve", "all.cts.json", "--output", "x.plan.json", option}).err;
  };
  EXPECT_EQ(solve("--verbose"), hint);
  EXPECT_EQ(solve("--quiet"), "");
  EXPECT_EQ(run({"check", "all.cts.json", "x.plan.json"}).err, hint);
}

TEST_F(ChoicesCommands, SolveSummarisesTheAssignment) {
  const auto log = [&](const std::string& name) {
    return run({"solve", name + ".cts.json", "--output", "x.plan.json", "--omega", "0"}).out;
  };
  EXPECT_THAT(log("goals"), HasSubstr("\nAssignment    a: no task -> [0, 0]\n"
                                      "              no task: b\nPlan file     x.plan.json\n"));
  std::filesystem::remove(directory_.path() / "x.plan.json");
  EXPECT_THAT(log("need"), HasSubstr("\nAssignment    "));
}

TEST_F(ChoicesCommands, VerboseNamesTheCountersOfTheSearchForAssignments) {
  const std::string log =
      run({"solve", "need.cts.json", "--output", "x.plan.json", "--omega", "0", "--verbose"}).out;
  EXPECT_THAT(log, HasSubstr("\nChoices       assignments searched one after the other: 1\n"));
  EXPECT_THAT(log, HasSubstr("\nCores         "));
}

// The result is executed, re-planned and checked like any instance without choices.
TEST_F(ChoicesCommands, ConvertFixesChoices) {
  for (const std::string name : {"goals", "need"}) {
    const std::string cost = name == "goals" ? "2" : "4";
    const ProcessResult done = run({"convert", name + ".cts.json", name + "-fixed.cts.json",
                                    "--fix-choices", name + ".plan.json"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("wrote " + name + "-fixed.plan.json: 2 paths, cost " + cost));
    EXPECT_EQ(run({"check", name + "-fixed.cts.json", name + "-fixed.plan.json"}).out,
              "valid: cost " + cost + ", lower bound " + cost + ", gap 0.00 %, 2 agents\n");
    EXPECT_EQ(
        run({"execute", name + "-fixed.cts.json", name + "-fixed.plan.json", "--order", "o.json"})
            .exit_code,
        0);
    EXPECT_EQ(
        run({"replan", name + "-fixed.cts.json", name + "-fixed.plan.json", "--at", "1", "--quiet"})
            .exit_code,
        0);
  }
  EXPECT_THAT(read("goals-fixed.cts.json"), HasSubstr(R"("goal":[0,0])"));
  EXPECT_THAT(read("need-fixed.cts.json"), HasSubstr(R"("agents":["b"])"));
}

TEST_F(ChoicesCommands, FixingChoicesRefusesWrongPlans) {
  const std::size_t before = files().size();
  EXPECT_EQ(
      refused({"convert", "need.cts.json", "x.cts.json", "--fix-choices", "goals.plan.json"}),
      "goals.plan.json: /agents: task 't' is visited by 0 of its agents; expected at least 1");
  EXPECT_EQ(
      refused({"convert", "need.cts.json", "need.cts.json", "--fix-choices", "need.plan.json"}),
      "need.cts.json: is the instance; expected another file to write to");
  EXPECT_EQ(
      refused({"convert", "need.cts.json", "x.yaml", "--fix-choices", "need.plan.json"}),
      "--fix-choices: OUT has another format; expected a *.cts.json (see 'grove convert --help')");
  EXPECT_EQ(
      refused({"convert", "need.cts.json", "x.csv", "--plan", "need.plan.json", "--fix-choices",
               "need.plan.json", "--to", "waypoints"}),
      "--fix-choices: allowed only with instances, not with --plan (see 'grove convert --help')");
  EXPECT_EQ(files().size(), before);
}

TEST_F(ChoicesCommands, FixingChoicesRefusesRestsWithinRoads) {
  directory_.write("r.roadmap.json", R"({"vertices": [{"id": "v", "at": [0, 0]},
      {"id": "w", "at": [3, 0]}], "edges": [{"from": "v", "to": "w", "steps": 3}]})");
  directory_.write("r.cts.json", R"({"roadmap": "r.roadmap.json", "agents": [
      {"id": "a", "start": "v"}, {"id": "b", "start": "w"}],
      "tasks": [{"id": "t", "cell": "v", "agents": "*", "need": 1}]})");
  directory_.write("r.plan.json", R"({"status": "feasible", "cost": 1, "lower_bound": 0, "omega": 0,
      "agents": [{"id": "a", "sequence": ["t"], "cost": 1,
      "work": [{"task": "t", "begin": 0, "end": 0}], "path": [["v"], ["v", "w", 1]]},
      {"id": "b", "sequence": [], "cost": 0, "path": [["w"]]}]})");
  EXPECT_EQ(refused({"convert", "r.cts.json", "x.cts.json", "--fix-choices", "r.plan.json"}),
            "r.plan.json: /agents: agent 'a' visits a task by choice and then rests within a road; "
            "expected that it rests on a vertex");
  EXPECT_FALSE(std::filesystem::exists(directory_ / "x.cts.json"));
}

TEST_F(ChoicesCommands, ViewRefusesCertificates) {
  directory_.write("p.proof", "grove-proof 1\n");
  EXPECT_EQ(refused({"view", "goals.cts.json", "--proof", "p.proof", "--output", "x.html"}),
            "goals.cts.json: /agents/0/goals: " + kGoals +
                "views of certificates do not support yet" + kGoalsEnd);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "x.html"));
}

TEST_F(ChoicesCommands, ConvertKeepsOrRefusesChoices) {
  for (const char* to : {"libmrp", "mgcbs", "mapfw", "scen"})
    for (const std::string instance : {"goals", "need"}) {
      const std::string text = refused({"convert", instance + ".cts.json", "out", "--to", to});
      EXPECT_THAT(text,
                  HasSubstr(instance == "goals" ? ": /agents/0/goals: agent 'a' " : ": /tasks/0"))
          << to;
      EXPECT_FALSE(std::filesystem::exists(directory_ / "out"));
    }
  for (const char* to : {"libmrp", "mapf-visualizer", "eecbs"})
    EXPECT_THAT(
        refused({"convert", "--plan", "need.plan.json", "need.cts.json", "out", "--to", to}),
        StartsWith("need.cts.json: /tasks/0/need: " + kNeed + "cannot be represented in "))
        << to;
  for (const std::string instance : {"goals.cts.json", "need.cts.json"}) {
    EXPECT_EQ(run({"convert", instance, "copy.cts.json"}).exit_code, 0);
    EXPECT_EQ(run({"convert", "copy.cts.json", "again.cts.json"}).exit_code, 0);
    EXPECT_EQ(file_content(directory_ / "again.cts.json"),
              file_content(directory_ / "copy.cts.json"));
  }
  EXPECT_THAT(file_content(directory_ / "copy.cts.json"), HasSubstr(R"("agents":"*","need":1)"));
}

}  // namespace choices_commands_test
}  // namespace grove::detail
