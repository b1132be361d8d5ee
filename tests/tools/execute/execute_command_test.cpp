// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace execute_command_test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAreArray;

class ExecuteCommand : public ::testing::Test {
 protected:
  static std::string data(const std::string& name) { return std::string(GROVE_DATA) + "/" + name; }
  std::string plan_of(const std::string& instance) {
    const std::string plan = directory_ / "p.plan.json";
    EXPECT_EQ(run_grove({"solve", instance, "--quiet", "--output", plan}).exit_code, 0);
    return plan;
  }
  ProcessResult execute(std::vector<std::string> more) {
    std::vector<std::string> words{"execute", instance_, plan_};
    words.insert(words.end(), more.begin(), more.end());
    return run_grove(words);
  }
  json read(const std::string& name) const {
    std::ifstream file(directory_ / name);
    return json::parse(file);
  }

  TemporaryDirectory directory_;
  const std::string instance_ = data("rooms-32x32_n10_m30.cts.json");
  const std::string plan_ = plan_of(instance_);
};

TEST_F(ExecuteCommand, ExecutedPlansAreValid) {
  for (const std::vector<std::string>& disturbances :
       {std::vector<std::string>{},
        {"--delays", "0.5", "--seed", "3"},
        {"--slow", "a1=2.5"},
        {"--stop", "a2@10=60", "--stop", "a3@0=5"}}) {
    std::vector<std::string> words = disturbances;
    words.insert(words.end(), {"--output", directory_ / "driven.plan.json"});
    const ProcessResult done = execute(words);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("driven undisturbed"));
    const ProcessResult checked = run_grove({"check", instance_, directory_ / "driven.plan.json"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
  }
}

TEST_F(ExecuteCommand, ExecutionKeepsNoFollowing) {
  std::filesystem::remove(plan_);
  ASSERT_EQ(
      run_grove({"solve", instance_, "--quiet", "--no-following", "--output", plan_}).exit_code, 0);
  ASSERT_EQ(execute({"--delays", "0.3", "--switch", "--output", directory_ / "driven.plan.json"})
                .exit_code,
            0);
  EXPECT_EQ(read("driven.plan.json")["following"], false);
  const ProcessResult checked = run_grove({"check", instance_, directory_ / "driven.plan.json"});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

// As in plan files, the planned start of a task that began before the plan is negative.
TEST_F(ExecuteCommand, TaskBegunBeforeThePlanHasNegativePlannedTime) {
  std::ofstream(directory_ / "row.map") << "type octile\nheight 1\nwidth 3\nmap\n...\n";
  const std::string row = directory_ / "row.cts.json";
  std::ofstream(row) << R"({"map": "row.map",
      "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0], "working": {"task": "t", "done": 2}}],
      "tasks": [{"id": "t", "cell": [0, 0], "agents": ["a"], "duration": 5}]})";
  const std::string plan = plan_of(row);
  ASSERT_EQ(run_grove({"execute", row, plan, "--order", directory_ / "order.json"}).exit_code, 0);
  const json actions = read("order.json")["robots"][0]["actions"];
  EXPECT_EQ(actions[0]["planned"], -2);
  EXPECT_EQ(actions[0]["steps"], 3);
  EXPECT_EQ(actions[1]["planned"], 3);
}

TEST_F(ExecuteCommand, StopDelaysAtMostItsDuration) {
  ASSERT_EQ(execute({"--output", directory_ / "calm.json"}).exit_code, 0);
  ASSERT_EQ(execute({"--stop", "a2@10=60", "--output", directory_ / "late.json"}).exit_code, 0);
  const auto cost = [&](const char* file) { return int(read(file)["agents"][2]["cost"]); };
  EXPECT_GT(cost("late.json"), cost("calm.json"));
  EXPECT_LE(cost("late.json"), cost("calm.json") + 60);
  // The stop keeps the robot on one cell for at least 60 steps.
  const json path = read("late.json")["agents"][2]["path"];
  std::size_t longest = 0;
  for (std::size_t t = 1, since = 0; t < path.size(); ++t) {
    if (path[t] != path[t - 1]) since = t;
    longest = std::max(longest, t - since);
  }
  EXPECT_GE(longest, 60u);
}

// In the file the actions of each robot lead from its start along its path in the plan and visit
// all its tasks. Each dependency names an existing action.
TEST_F(ExecuteCommand, WritesThePassingOrder) {
  ASSERT_EQ(execute({"--order", directory_ / "order.json"}).exit_code, 0);
  const json order = read("order.json");
  EXPECT_EQ(order["format"], "grove passing order 1");
  const json plan = json::parse(std::ifstream(plan_));
  std::map<std::string, std::size_t> actions;
  for (const json& robot : order["robots"]) actions[robot["id"]] = robot["actions"].size();
  int dependency_count = 0;
  std::vector<std::tuple<std::string, std::string, json>> visited;
  for (std::size_t i = 0; i < order["robots"].size(); ++i) {
    const json& robot = order["robots"][i];
    json places = json::array({robot["start"]});
    for (const json& action : robot["actions"]) {
      EXPECT_EQ(action["do"], "move");
      places.push_back(action["to"]);
      if (!action.contains("after")) continue;
      ++dependency_count;
      EXPECT_LT(action["after"]["action"], actions.at(action["after"]["robot"]));
    }
    for (std::size_t k = 0; k < robot["actions"].size(); ++k)
      for (const json& task : robot["actions"][k].value("visits", json::array()))
        visited.emplace_back(robot["id"], task, places[k + 1]);
    for (const json& task : robot.value("visits", json::array()))
      visited.emplace_back(robot["id"], task, places[0]);
    json path = plan["agents"][i]["path"];
    path.erase(std::unique(path.begin(), path.end()), path.end());
    EXPECT_EQ(places, path);
  }
  EXPECT_GT(dependency_count, 50);
  std::vector<std::tuple<std::string, std::string, json>> tasks;
  const json instance = json::parse(std::ifstream(instance_));
  for (const json& task : instance["tasks"])
    for (const json& agent : task["agents"]) tasks.emplace_back(agent, task["id"], task["cell"]);
  EXPECT_THAT(visited, UnorderedElementsAreArray(tasks));
}

TEST_F(ExecuteCommand, ReportsBlockedRobots) {
  const ProcessResult done = execute({"--fail", "a3@12", "--view", directory_ / "page.html"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("a3 has failed"));
  EXPECT_THAT(done.out, HasSubstr("waits for a3"));
  EXPECT_TRUE(std::filesystem::exists(directory_ / "page.html"));
}

TEST_F(ExecuteCommand, AcceptsTheOldNameOfFail) {
  EXPECT_EQ(execute({"--dies", "a3@12"}).out, execute({"--fail", "a3@12"}).out);
  EXPECT_THAT(execute({"--help"}).out, Not(HasSubstr("--dies")));
}

TEST_F(ExecuteCommand, SameSeedGivesTheSameExecution) {
  const auto output_with = [&](const char* seed) {
    return execute({"--delays", "0.3", "--seed", seed}).out;
  };
  EXPECT_EQ(output_with("1"), output_with("1"));
  EXPECT_NE(output_with("1"), output_with("2"));
}

TEST_F(ExecuteCommand, RefusesInvalidOptionsAndPlans) {
  const auto complaint = [](const ProcessResult& result) {
    EXPECT_EQ(result.exit_code, 2) << result.out;
    return result.err;
  };
  EXPECT_THAT(complaint(execute({"--slow", "a1"})), HasSubstr("--slow: found 'a1'"));
  EXPECT_THAT(complaint(execute({"--slow", "a1=0.5"})), HasSubstr("a factor from 1 to 1000"));
  EXPECT_THAT(complaint(execute({"--slow", "zz=2"})), HasSubstr("a robot of the instance"));
  EXPECT_THAT(complaint(execute({"--stop", "a1@x=3"})), HasSubstr("--stop"));
  EXPECT_THAT(complaint(execute({"--fail", "a1"})), HasSubstr("ROBOT@TIME"));
  EXPECT_THAT(complaint(execute({"--delays", "2"})), HasSubstr("--delays"));
  EXPECT_THAT(complaint(execute({"--delay-steps", "2"})), HasSubstr("allowed only with --delays"));
  json plan = json::parse(std::ifstream(plan_));
  plan["agents"][0]["path"][1] = {0, 0};
  std::ofstream(directory_ / "bad.json") << plan;
  EXPECT_THAT(complaint(run_grove({"execute", instance_, directory_ / "bad.json"})),
              HasSubstr("is not valid, so it cannot be driven"));
}

}  // namespace execute_command_test
}  // namespace grove::detail
