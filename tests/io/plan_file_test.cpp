// SPDX-License-Identifier: MIT
#include "io/plan_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "model/check.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace plan_file_test {

Instance instance() {
  InstanceBuilder builder(Grid(3, 2, std::vector<bool>(6, true)));
  builder.add_agent("a", {0, 0}, Position{2, 0});
  builder.add_agent("m", {0, 1}, std::nullopt);
  builder.add_task("t", {1, 1}, std::vector<std::string>{"m"});
  return std::move(builder).build();
}

Solution solution() {
  Solution result;
  result.status = Status::kOptimal;
  result.plan = Plan{3, {{2, {}, {0, 1, 2}}, {1, {0}, {3, 4}}}};
  result.lower_bound = 3;
  result.omega = Omega::parse("0.01");
  result.stats.counts["nodes_expanded"] = 7;
  result.stats.measures["wall_s"] = 0.25;
  result.stats.texts["stopped_by"] = "nothing";
  return result;
}

const std::string kWritten =
    "{\n \"status\": \"optimal\",\n \"cost\": 3,\n \"lower_bound\": 3,\n \"omega\": 0.01,\n"
    " \"agents\": [\n"
    "  {\"id\":\"a\",\"sequence\":[],\"cost\":2,\"path\":[[0,0],[1,0],[2,0]]},\n"
    "  {\"id\":\"m\",\"sequence\":[\"t\"],\"cost\":1,\"path\":[[0,1],[1,1]]}],\n"
    " \"stats\": {\n  \"stopped_by\": \"nothing\",\n  \"wall_s\": 0.25,\n"
    "  \"nodes_expanded\": 7}}\n";

class PlanFile : public ::testing::Test {
 protected:
  std::string written(const Solution& s) {
    write_solution(directory_ / "out.json", instance(), s);
    return file_content(directory_ / "out.json");
  }
  Solution read(const std::string& content) {
    return read_solution(directory_.write("p.json", content), instance());
  }
  std::string refused(const std::string& content) {
    return refusal([&] { read(content); });
  }
  // Returns the message for the written plan in which `from` is replaced by `to`.
  std::string refused_with(const std::string& from, const std::string& to) {
    std::string text = kWritten;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return refused(text.replace(text.find(from), from.size(), to));
  }

  TemporaryDirectory directory_;
};

TEST_F(PlanFile, IsWrittenOneAgentPerLine) {
  EXPECT_EQ(written(solution()), kWritten);
}

TEST_F(PlanFile, RoundTrips) {
  const Solution back = read(kWritten);
  EXPECT_EQ(back.status, Status::kOptimal);
  EXPECT_EQ(back.omega, Omega::parse("0.01"));
  EXPECT_EQ(back.stats.counts.at("nodes_expanded"), 7);
  EXPECT_EQ(back.stats.measures.at("wall_s"), 0.25);
  EXPECT_EQ(back.stats.texts.at("stopped_by"), "nothing");
  EXPECT_EQ(written(back), kWritten);
}

TEST_F(PlanFile, ReadsOldNamesOfCounters) {
  std::string text = kWritten;
  text.replace(text.find("nodes_expanded"), 14, "joint_pairs");
  EXPECT_EQ(read(text).stats.counts.at("joint_mdd_nodes"), 7);
}

TEST_F(PlanFile, WithoutAPlanHasNeitherCostNorAgents) {
  Solution unknown;
  unknown.lower_bound = 12;
  unknown.omega = Omega::infinite();
  const std::string text = written(unknown);
  EXPECT_EQ(text,
            "{\n \"status\": \"unknown\",\n \"lower_bound\": 12,\n \"omega\": \"inf\",\n "
            "\"stats\": {}}\n");
  const Solution back = read(text);
  EXPECT_FALSE(back.plan);
  EXPECT_EQ(back.lower_bound, 12);
  EXPECT_TRUE(back.omega.is_infinite());
}

TEST_F(PlanFile, HoldsEveryOmega) {
  for (const char* omega : {"0", "1", "0.1", "0.000000001", "123.456", "1e6"}) {
    Solution s = solution();
    s.omega = Omega::parse(omega);
    EXPECT_EQ(read(written(s)).omega, s.omega) << omega;
  }
}

TEST_F(PlanFile, WritesStatsThatJsonCannotHold) {
  Solution s = solution();
  s.stats.measures["rate"] = std::numeric_limits<double>::infinity();
  s.stats.texts["host"] = "\xff\n\"";
  const Solution back = read(written(s));
  EXPECT_EQ(back.stats.measures.count("rate"), 0U);  // null: JSON has no infinity
  EXPECT_EQ(back.stats.texts.at("host"), "\xEF\xBF\xBD\n\"");
}

TEST_F(PlanFile, TakesAgentsInAnyOrder) {
  const Solution back =
      read(R"({"status": "feasible", "cost": 0, "lower_bound": 0, "omega": 0, "agents": [
    {"id": "m", "sequence": [], "cost": 5, "path": [[0, 1]]}, {"id": "a", "sequence": [], "cost": 6, "path": [[0, 0]]}]})");
  EXPECT_EQ(back.plan->agents[0].cost, 6);
  EXPECT_EQ(back.plan->agents[1].cost, 5);
}

TEST_F(PlanFile, AcceptsMissingAgentsForTheChecker) {
  const Solution back = read(R"({"status": "feasible", "cost": 0, "lower_bound": 0, "omega": 0,
    "agents": [{"id": "m", "sequence": [], "cost": 5, "path": []}]})");
  ASSERT_EQ(back.plan->agents.size(), 2U);
  EXPECT_TRUE(back.plan->agents[0].path.empty());
  EXPECT_TRUE(back.plan->agents[1].path.empty());
}

TEST_F(PlanFile, AcceptsWrongNumbersForTheChecker) {
  const Solution back =
      read(R"({"status": "optimal", "cost": 99, "lower_bound": -5, "omega": 0, "agents": []})");
  EXPECT_EQ(back.plan->cost, 99);
  EXPECT_EQ(back.lower_bound, -5);
}

TEST_F(PlanFile, RefusesInvalidFilesWithThePlace) {
  EXPECT_EQ(refused_with("\"optimal\"", "\"solved\""),
            "p.json: /status: found \"solved\"; expected optimal, bounded, feasible, infeasible or "
            "unknown");
  EXPECT_EQ(refused_with("\"status\"", "\"stat\""),
            "p.json: /: unknown key 'stat'; expected 'status', if that is meant");
  EXPECT_EQ(refused_with("\"lower_bound\"", "\"bound\""),
            "p.json: /: unknown key 'bound'; expected 'lower_bound', if that is meant");
  EXPECT_EQ(refused_with("\"cost\": 3", "\"cots\": 3"),
            "p.json: /: unknown key 'cots'; expected 'cost', if that is meant");
  EXPECT_EQ(refused_with("\"agents\"", "\"agent\""),
            "p.json: /: unknown key 'agent'; expected 'agents', if that is meant");
  EXPECT_EQ(refused_with("\"cost\": 3", "\"cost\": 3.5"),
            "p.json: /cost: found 3.5; expected an integer from 0 to 1152921504606846976");
  EXPECT_EQ(refused_with("\"cost\":2", "\"cost\":99999999999"),
            "p.json: /agents/0/cost: found 99999999999; expected an integer from 0 to 1073741824");
  EXPECT_EQ(
      refused_with("[1,1]", "[1,2]"),
      "p.json: /agents/1/path/1: cell [1, 2] is outside the map; expected x in 0..2 and y in 0..1");
  EXPECT_EQ(refused_with("[1,1]", "[1,1.5]").substr(0, 40),
            "p.json: /agents/1/path/1/1: found 1.5; e");
  EXPECT_EQ(
      refused_with("[\"t\"]", "[\"u\"]"),
      "p.json: /agents/1/sequence/0: there is no task 'u' in the instance; expected the id of "
      "one of its tasks");
  EXPECT_EQ(
      refused_with("\"m\"", "\"b\""),
      "p.json: /agents/1/id: there is no agent 'b' in the instance; expected the id of one of "
      "its agents");
  EXPECT_EQ(refused_with("\"m\"", "\"a\""),
            "p.json: /agents/1/id: agent 'a' appears twice; expected each agent once");
  EXPECT_EQ(
      refused_with(
          "{\n  \"stopped_by\": \"nothing\",\n  \"wall_s\": 0.25,\n  \"nodes_expanded\": 7}", "7"),
      "p.json: /stats: found 7; expected an object");
}

TEST_F(PlanFile, RefusesInvalidOmegas) {
  for (const char* omega :
       {"-0.1", "1e7", "\"infinity\"", "\"0.01\"", "null", "1e-10", "[]", "true"})
    EXPECT_EQ(refused_with("0.01", omega).substr(0, 15), "p.json: /omega:") << omega;
}

TEST_F(PlanFile, EveryTruncationIsRefused) {
  for (std::size_t size = 0; size + 2 < kWritten.size(); ++size)
    EXPECT_NE(refused(kWritten.substr(0, size)), "accepted") << size;
}

TEST_F(PlanFile, IsNotWrittenIfTheCheckerRefusesIt) {
  Solution s = solution();
  s.plan->agents[1].path = {3, 5};
  try {
    written(s);
    FAIL();
  } catch (const InvalidPlan& error) {
    EXPECT_EQ(error.violation().json_pointer, "/agents/1/path/1");
  }
  s = solution();
  s.lower_bound = 2;  // contradicts the status `optimal`
  EXPECT_THROW(written(s), InvalidPlan);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out.json"));
}

// Following is forbidden if the instance or the solution forbids it.
TEST_F(PlanFile, RecordsThatFollowingIsForbidden) {
  EXPECT_NE(solution_text(instance().without_following(), solution()).find("\"following\": false"),
            std::string::npos);
  Solution s = solution();
  s.may_follow = false;
  EXPECT_FALSE(read(written(s)).may_follow);
  InstanceBuilder builder(Grid(3, 1, std::vector<bool>(3, true)));
  builder.add_agent("a", {0, 0}, Position{1, 0});
  builder.add_agent("b", {1, 0}, Position{2, 0});
  const Instance row = std::move(builder).build();
  s.plan = Plan{2, {{1, {}, {0, 1}}, {1, {}, {1, 2}}}};
  s.lower_bound = 2;
  EXPECT_THROW(solution_text(row, s), InvalidPlan);
  s.may_follow = true;
  EXPECT_THROW(solution_text(row.without_following(), s), InvalidPlan);
  EXPECT_NO_THROW(solution_text(row, s));
}

TEST_F(PlanFile, RefusesAMissingFolder) {
  EXPECT_EQ(refusal([&] { write_solution(directory_ / "none/p.json", instance(), solution()); }),
            "p.json: cannot be written: No such file or directory");
}

}  // namespace plan_file_test
}  // namespace grove::detail
