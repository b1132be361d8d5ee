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
  // Expects that the run succeeds and that the checker accepts the files that it writes.
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
  std::string first_task() const {
    std::ifstream file(instance_);
    return json::parse(file)["tasks"][0]["id"];
  }
  json read(const std::string& name) const {
    std::ifstream file(directory_ / name);
    return json::parse(file);
  }

  TemporaryDirectory directory_;
  const std::string instance_ = data("rooms-32x32_n10_m30.cts.json");
  const std::string plan_ = plan_of(instance_);
};

TEST_F(ReplanCommand, RemainderIsAValidInstanceWithAPlan) {
  expect_valid({"--at", "20"});
  EXPECT_LT(read("then.cts.json")["tasks"].size(), 30u);
  const json before = read("p.plan.json")["agents"];
  const json agents = read("then.cts.json")["agents"];
  for (std::size_t i = 0; i < agents.size(); ++i)
    EXPECT_EQ(agents[i]["start"],
              before[i]["path"][std::min<std::size_t>(20, before[i]["path"].size() - 1)]);
}

TEST_F(ReplanCommand, DelayedRobotIsAtItsEarlierPlace) {
  expect_valid({"--at", "20", "--late", "a3=5", "--late", "a1=2"});
  const json before = read("p.plan.json")["agents"];
  const json agents = read("then.cts.json")["agents"];
  EXPECT_EQ(agents[3]["start"], before[3]["path"][15]);
  EXPECT_EQ(agents[1]["start"], before[1]["path"][18]);
}

TEST_F(ReplanCommand, OptionsMayComeBeforeTheFiles) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--at", "20", "--late", "a3=5", "--late", "a1=2"},
        {"--at", "0", "--drop-task", first_task()}}) {
    std::vector<std::string> words{"replan"};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(),
                 {instance_, plan_, "--quiet", "--output", directory_ / "then.plan.json"});
    const ProcessResult done = run_grove(words);
    EXPECT_EQ(done.exit_code, 0) << done.err;
  }
  const std::string options = read("then.plan.json")["stats"]["options"];
  EXPECT_THAT(options, testing::HasSubstr("--drop-task " + first_task()));
  expect_valid({"--at", "20", "--late", "a3=5", "--late", "a1=2"});
  EXPECT_THAT(std::string(read("then.plan.json")["stats"]["options"]),
              testing::HasSubstr("--late a3=5 --late a1=2"));
}

TEST_F(ReplanCommand, CommittedStepsAreKept) {
  const json path = read("p.plan.json")["agents"][0]["path"];
  const json ahead = path[30];
  const std::string blocked = std::to_string(int(ahead[0])) + "," + std::to_string(int(ahead[1]));
  expect_valid({"--at", "10", "--commit", "4", "--blocked", blocked});
  const json now = read("then.plan.json")["agents"][0]["path"];
  for (std::size_t t = 0; t <= 4; ++t) EXPECT_EQ(now[t], path[t + 10]);
  EXPECT_EQ(std::ranges::count(now, ahead), 0);
  // The map with the blocked cell is written next to the instance.
  EXPECT_EQ(read("then.cts.json")["map"], "then.map");
}

// The output file holds an earlier plan, made without --commit. It must be replaced even if it is
// cheaper, because it can deviate from the committed steps.
TEST_F(ReplanCommand, CommittedStepsReplaceACheaperPlan) {
  const json path = read("p.plan.json")["agents"][3]["path"];
  expect_valid({"--at", "20", "--late", "a3=6", "--omega", "0"});
  const int without = read("then.plan.json")["cost"];
  expect_valid({"--at", "20", "--late", "a3=6", "--commit", "6"});
  const json now = read("then.plan.json");
  for (std::size_t t = 0; t <= 6; ++t) EXPECT_EQ(now["agents"][3]["path"][t], path[t + 14]);
  EXPECT_GE(int(now["cost"]), without);
}

TEST_F(ReplanCommand, WarnsIfItReplacesAnotherInstance) {
  expect_valid({"--at", "20"});
  EXPECT_THAT(replan({"--at", "20"}).err, Not(HasSubstr("another instance")));
  EXPECT_THAT(replan({"--at", "21"}).err, HasSubstr("then.cts.json had another instance"));
}

TEST_F(ReplanCommand, AddsAndDropsTasks) {
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

// The plan file records that following is forbidden, so that --no-following need not be repeated.
TEST_F(ReplanCommand, PlanWithoutFollowingForbidsFollowingLater) {
  std::filesystem::remove(plan_);
  ASSERT_EQ(run_grove({"solve", instance_, "--quiet", "--omega", "inf", "--no-following",
                       "--output", plan_})
                .exit_code,
            0);
  const std::string next = directory_ / "next.plan.json";
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{},
        {"--commit", "5"},
        {"--late", "a3=5"},
        {"--late", "a1=7", "--commit", "5", "--no-following"}}) {
    std::vector<std::string> words{"--at", "20"};
    words.insert(words.end(), more.begin(), more.end());
    std::filesystem::remove(directory_ / "then.plan.json");
    expect_valid(words);
    EXPECT_EQ(read("then.plan.json")["following"], false);
    // Re-plan once more, from the files just written.
    ASSERT_EQ(run_grove({"replan", directory_ / "then.cts.json", directory_ / "then.plan.json",
                         "--at", "3", "--quiet", "--output", next})
                  .exit_code,
              0);
    EXPECT_EQ(read("next.plan.json")["following"], false);
    EXPECT_EQ(run_grove({"check", directory_ / "next.cts.json", next}).exit_code, 0);
  }
}

TEST_F(ReplanCommand, RefusesAPlanWithFollowingIfNoFollowing) {
  const std::string map = write("row.map", "type octile\nheight 1\nwidth 4\nmap\n....\n");
  const std::string row = write("row.cts.json", R"({"map": "row.map", "tasks": [], "agents": [
      {"id": "a", "start": [0, 0], "goal": [2, 0]}, {"id": "b", "start": [1, 0], "goal": [3, 0]}]})");
  const std::string plan = directory_ / "row.plan.json";
  ASSERT_EQ(run_grove({"solve", row, "--quiet", "--omega", "0", "--output", plan}).exit_code, 0);
  const ProcessResult done = run_grove({"replan", row, plan, "--at", "1", "--no-following"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(
      done.err,
      HasSubstr("row.plan.json: /agents/0/path/1: is not valid with --no-following, and was made "
                "without it, so it cannot be driven: "));
}

TEST_F(ReplanCommand, InstanceIsNamedAfterThePlan) {
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"replan", instance_, plan_, "--quiet", "--at", "20"};
    words.insert(words.end(), more.begin(), more.end());
    return run_grove(words);
  };
  ASSERT_EQ(run({"-o", directory_ / "first.plan.json"}).exit_code, 0);
  ASSERT_EQ(run({"-o", directory_ / "second.plan.json", "--late", "a3=5"}).exit_code, 0);
  for (const std::string name : {"first", "second"})
    EXPECT_EQ(
        run_grove({"check", directory_ / (name + ".cts.json"), directory_ / (name + ".plan.json")})
            .exit_code,
        0)
        << name;
  ASSERT_EQ(run({"--output-instance", directory_ / "third.cts.json"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "third.plan.json"));
}

TEST_F(ReplanCommand, DoesNotOverwriteItsInputs) {
  const std::string tasks = R"({"id": "n1", "cell": [1, 1], "agents": ["a0"]})";
  const std::string file = write("n1.json", tasks);
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"replan", instance_, plan_,        "--quiet",
                                   "--at",   "20",      "--new-task", file};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult done = run_grove(words);
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(file_content(file), tasks);
    return done.err;
  };
  EXPECT_THAT(refused({"-o", file}), HasSubstr("n1.json: is a file of new tasks"));
  EXPECT_THAT(refused({"--output-instance", file}), HasSubstr("is a file of new tasks"));
  EXPECT_THAT(refused({"-o", directory_ / "x.plan.json", "--log", file}),
              HasSubstr("is a file of new tasks"));
  EXPECT_THAT(refused({"-o", plan_}), HasSubstr("is the plan that is being executed"));
  EXPECT_THAT(refused({"-o", directory_ / "x.plan.json", "--log", plan_}),
              HasSubstr("is the plan that is being executed"));
}

TEST_F(ReplanCommand, RefusesTimesBeyondThePlan) {
  const auto agents = read("p.plan.json")["agents"];
  int end = 0;
  for (const json& agent : agents) end = std::max(end, int(agent["cost"]));
  expect_valid({"--at", std::to_string(end)});
  EXPECT_EQ(read("then.plan.json")["cost"], 0);
  std::filesystem::remove(directory_ / "then.cts.json");
  EXPECT_THAT(complaint({"--at", std::to_string(end + 1)}),
              HasSubstr("--at: found " + std::to_string(end + 1) + "; expected at most " +
                        std::to_string(end)));
  EXPECT_THAT(complaint({"--at", "20", "--late", "a3=21"}),
              HasSubstr("--late: 'a3' cannot be 21 steps late; expected at most 20"));
}

TEST_F(ReplanCommand, RefusesToBlockABlockedCell) {
  const std::string map = file_content(data("rooms-32x32.map"));
  const std::size_t first = map.find("map\n") + 4;
  const std::size_t wall = map.find('@', first) - first;
  const std::string cell = std::to_string(wall % 33) + "," + std::to_string(wall / 33);
  EXPECT_THAT(complaint({"--at", "3", "--blocked", cell}),
              HasSubstr("--blocked: '" + cell + "': the map is blocked there already"));
}

// A robot without a destination can end on any of its remaining tasks.
TEST_F(ReplanCommand, KeepsRobotsWithoutDestination) {
  write("row.map", "type octile\nheight 1\nwidth 5\nmap\n.....\n");
  const std::string row = write("row.cts.json", R"({"map": "row.map",
      "agents": [{"id": "a", "start": [2, 0]}],
      "tasks": [{"id": "s", "cell": [2, 0], "agents": ["a"]}, {"id": "t", "cell": [4, 0], "agents": ["a"]}]})");
  const std::string back =
      write("back.plan.json", R"({"status": "feasible", "cost": 4, "lower_bound": 0,
      "omega": "inf", "agents": [{"id": "a", "sequence": ["t", "s"], "cost": 4,
      "path": [[2, 0], [3, 0], [4, 0], [3, 0], [2, 0]]}], "stats": {}})");
  const std::string now = directory_ / "now.plan.json";
  ASSERT_EQ(run_grove({"replan", row, back, "--at", "0", "--quiet", "-o", now}).exit_code, 0);
  EXPECT_EQ(read("now.plan.json")["cost"], 2);
  EXPECT_EQ(read("now.plan.json")["status"], "optimal");
  EXPECT_FALSE(read("now.cts.json")["agents"][0].contains("goal"));
}

TEST_F(ReplanCommand, RefusesInvalidOptions) {
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
              HasSubstr("typo.json: /: unknown key 'agent'; expected 'agents'"));
  const std::string outside =
      write("outside.json", R"({"id": "n", "cell": [77, 1], "agents": ["a0"]})");
  EXPECT_THAT(complaint({"--at", "3", "--new-task", outside}), HasSubstr("outside.json: /cell"));
  const json soon = read("p.plan.json")["agents"][0]["path"][8];
  const std::string ahead = std::to_string(int(soon[0])) + "," + std::to_string(int(soon[1]));
  EXPECT_THAT(complaint({"--at", "3", "--commit", "9", "--blocked", ahead}),
              HasSubstr("--commit: found 9; expected at most 4"));
}

}  // namespace replan_command_test
}  // namespace grove::detail
