// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace replan_command_test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class ReplanCommand : public ::testing::Test {
 protected:
  static std::string data(const std::string& name) { return std::string(GROVE_DATA) + "/" + name; }
  std::string plan_of(const std::string& instance) {
    const std::string plan = directory_ / "p.plan.json";
    EXPECT_EQ(
        run_grove({"solve", instance, "--quiet", "--omega", "inf", "--output", plan}).exit_code, 0);
    return plan;
  }
  ProcessResult replan(std::vector<std::string> more) {
    std::vector<std::string> words{"replan",
                                   instance_,
                                   plan_,
                                   "--quiet",
                                   "--output-instance",
                                   directory_ / "then.cts.json",
                                   "--output",
                                   directory_ / "then.plan.json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_grove(words);
  }
  // Done, and the checker agrees with all that was written.
  void expect_valid(const std::vector<std::string>& words) {
    const ProcessResult done = replan(words);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const ProcessResult checked =
        run_grove({"check", directory_ / "then.cts.json", directory_ / "then.plan.json"});
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  }
  std::string complaint(const std::vector<std::string>& words) {
    const ProcessResult result = replan(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(directory_ / "then.cts.json"));
    return result.err;
  }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  json read(const std::string& name) const {
    std::ifstream file(directory_ / name);
    return json::parse(file);
  }

  TemporaryDirectory directory_;
  const std::string instance_ = data("rooms-32x32_n10_m30.cts.json");
  const std::string plan_ = plan_of(instance_);
};

TEST_F(ReplanCommand, WhatIsLeftIsAnInstanceWithAPlan) {
  expect_valid({"--at", "20"});
  EXPECT_LT(read("then.cts.json")["tasks"].size(), 30u);
  const json before = read("p.plan.json")["agents"];
  const json agents = read("then.cts.json")["agents"];
  for (std::size_t i = 0; i < agents.size(); ++i)
    EXPECT_EQ(agents[i]["start"],
              before[i]["path"][std::min<std::size_t>(20, before[i]["path"].size() - 1)]);
}

TEST_F(ReplanCommand, WhoIsLateIsWhereItWas) {
  expect_valid({"--at", "20", "--late", "a3=5", "--late", "a1=2"});
  const json before = read("p.plan.json")["agents"];
  const json agents = read("then.cts.json")["agents"];
  EXPECT_EQ(agents[3]["start"], before[3]["path"][15]);
  EXPECT_EQ(agents[1]["start"], before[1]["path"][18]);
}

TEST_F(ReplanCommand, WhatIsCommittedIsKept) {
  const json path = read("p.plan.json")["agents"][0]["path"];
  const json ahead = path[30];
  const std::string blocked = std::to_string(int(ahead[0])) + "," + std::to_string(int(ahead[1]));
  expect_valid({"--at", "10", "--commit", "4", "--blocked", blocked});
  const json now = read("then.plan.json")["agents"][0]["path"];
  for (std::size_t t = 0; t <= 4; ++t) EXPECT_EQ(now[t], path[t + 10]);
  EXPECT_EQ(std::ranges::count(now, ahead), 0);
  // The map on which it is closed lies beside the instance.
  EXPECT_EQ(read("then.cts.json")["map"], "then.map");
}

// A cheaper plan that is there goes another way.
TEST_F(ReplanCommand, WhatIsCommittedReplacesACheaperPlan) {
  const json path = read("p.plan.json")["agents"][3]["path"];
  expect_valid({"--at", "20", "--late", "a3=6", "--omega", "0"});
  const int without = read("then.plan.json")["cost"];
  expect_valid({"--at", "20", "--late", "a3=6", "--commit", "6"});
  const json now = read("then.plan.json");
  for (std::size_t t = 0; t <= 6; ++t) EXPECT_EQ(now["agents"][3]["path"][t], path[t + 14]);
  EXPECT_GE(int(now["cost"]), without);
}

TEST_F(ReplanCommand, TellsThatAnotherInstanceIsReplaced) {
  expect_valid({"--at", "20"});
  EXPECT_THAT(replan({"--at", "20"}).err, Not(HasSubstr("another instance")));
  EXPECT_THAT(replan({"--at", "21"}).err, HasSubstr("then.cts.json held another instance"));
}

TEST_F(ReplanCommand, TasksComeAndGo) {
  const std::string one =
      write("one.json", R"({"id": "n1", "cell": [1, 1], "agents": ["a0", "a4"]})");
  const std::string more = write(
      "more.json", R"({"tasks": [{"id": "n2", "cell": [2, 1], "agents": ["a1"], "duration": 3}]})");
  const std::string left = read("p.plan.json")["agents"][5]["sequence"].back();
  expect_valid({"--at", "5", "--new-task", one, "--new-task", more, "--drop-task", left});
  std::vector<std::string> tasks;
  const json then = read("then.cts.json");
  for (const json& task : then["tasks"]) tasks.push_back(task["id"]);
  EXPECT_THAT(tasks, ::testing::IsSupersetOf({"n1", "n2"}));
  EXPECT_EQ(std::ranges::count(tasks, left), 0);
}

TEST_F(ReplanCommand, RefusesWhatCannotBe) {
  EXPECT_THAT(complaint({}), HasSubstr("--at"));
  EXPECT_THAT(complaint({"--at", "-1"}), HasSubstr("--at"));
  EXPECT_THAT(complaint({"--at", "3", "--late", "a3"}), HasSubstr("--late: found 'a3'"));
  EXPECT_THAT(complaint({"--at", "3", "--late", "zz=3"}), HasSubstr("a robot of the instance"));
  EXPECT_THAT(complaint({"--at", "3", "--drop-task", "zz"}), HasSubstr("--drop-task: 'zz'"));
  EXPECT_THAT(complaint({"--at", "3", "--blocked", "3"}), HasSubstr("X,Y"));
  EXPECT_THAT(complaint({"--at", "3", "--blocked", "99,1"}), HasSubstr("0..31"));
  const json start = read("p.plan.json")["agents"][2]["path"][0];
  const std::string there = std::to_string(int(start[0])) + "," + std::to_string(int(start[1]));
  EXPECT_THAT(complaint({"--at", "0", "--blocked", there}), HasSubstr("'a2' is there"));
  const std::string unknown =
      write("unknown.json", R"({"tasks": [{"id": "n", "cell": [1, 1], "agents": ["zz"]}]})");
  EXPECT_THAT(complaint({"--at", "3", "--new-task", unknown}),
              HasSubstr("unknown.json: /tasks/0/agents/0: there is no agent 'zz'"));
  const std::string typo = write("typo.json", R"({"id": "n", "cell": [1, 1], "agent": ["a0"]})");
  EXPECT_THAT(complaint({"--at", "3", "--new-task", typo}),
              HasSubstr("typo.json: /: key 'agents' is missing"));
  const std::string outside =
      write("outside.json", R"({"id": "n", "cell": [77, 1], "agents": ["a0"]})");
  EXPECT_THAT(complaint({"--at", "3", "--new-task", outside}), HasSubstr("outside.json: /cell"));
  const json soon = read("p.plan.json")["agents"][0]["path"][8];
  const std::string ahead = std::to_string(int(soon[0])) + "," + std::to_string(int(soon[1]));
  EXPECT_THAT(complaint({"--at", "3", "--commit", "9", "--blocked", ahead}),
              HasSubstr("--commit: found 9; expected 4 at most"));
}

}  // namespace replan_command_test
}  // namespace grove::detail
