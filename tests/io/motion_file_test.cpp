// SPDX-License-Identifier: MIT
// Tests instance files with turning agents, tasks with a duration and tasks in execution at the
// start, and the plan files for them.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "io/instance_file.h"
#include "io/plan_file.h"
#include "model/check.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace motion_file_test {

const std::string kRoads = R"({
 "vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [3, 0]}],
 "edges": [{"from": "A", "to": "B", "steps": 3}]})";
// Tasks of agents "a" and "b" on [1, 0].
const std::string kWork =
    R"([{"id": "t", "cell": [1, 0], "agents": ["a"], "duration": 3},
        {"id": "u", "cell": [1, 0], "agents": ["a", "b"]}])";
const std::string kOther = R"(, {"id": "b", "start": [3, 1]}])";

class MotionFile : public ::testing::Test {
 protected:
  MotionFile() {
    write("m.map", "type octile\nheight 2\nwidth 4\nmap\n....\n.@..\n");
    write("r.roadmap.json", kRoads);
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(directory_.path() / name) << text;
  }
  Instance instance(const std::string& agents, const std::string& tasks = "[]",
                    const std::string& map = R"("map": "m.map")") {
    write("i.json", "{" + map + R"(, "agents": )" + agents + R"(, "tasks": )" + tasks + "}");
    return read_instance(directory_.path() / "i.json").instance;
  }
  // Returns the message for an agent "a" with these members in addition to its id.
  std::string refused_agent(const std::string& members, const std::string& tasks = kWork) {
    return refusal([&] { instance(R"([{"id": "a", )" + members + "}" + kOther, tasks); });
  }
  std::string refused_on_roads(const std::string& members) {
    return refusal([&] {
      instance(R"([{"id": "a", "start": "A", "goal": "B", )" + members + "}]", "[]",
               R"("roadmap": "r.roadmap.json")");
    });
  }
  std::string refused_task(const std::string& members) {
    return refusal([&] {
      instance(R"([{"id": "a", "start": [0, 0]}])",
               R"([{"id": "t", "cell": [1, 0], "agents": ["a"], )" + members + "}]");
    });
  }
  Solution solution(const Instance& instance, const std::string& agents, int cost) {
    return parse_solution(R"({"status": "feasible", "cost": )" + std::to_string(cost) +
                              R"(, "lower_bound": 0, "omega": 0, "agents": )" + agents + "}",
                          "p.json", instance);
  }

  TemporaryDirectory directory_;
};

const std::string kTurns = R"("motion": "turning", )";

TEST_F(MotionFile, ReadsHeadingsAndDurations) {
  const Instance read = instance(
      R"([{"id": "a", "start": [0, 0], "goal": [3, 0], "motion": "turning", "turn_steps": 2,
           "heading": "W", "goal_heading": "S"},
          {"id": "b", "start": [2, 1, "N", "E", 2], "motion": "turning", "turn_steps": 3},
          {"id": "c", "start": [3, 1]}])",
      R"([{"id": "t", "cell": [2, 0], "agents": ["a", "c"], "duration": 3},
          {"id": "u", "cell": [2, 0], "agents": ["a"]}])");
  EXPECT_EQ(read.world().name(read.agent(0).start), R"([0, 0, "W"])");
  EXPECT_EQ(read.world().name(read.agent(1).start), R"([2, 1, "N", "E", 2])");
  EXPECT_EQ(read.world().name(read.agent(2).start), "[3, 1]");
  EXPECT_EQ(read.agent(0).goal_heading, Heading::kSouth);
  EXPECT_EQ(read.task(0).duration, 3);
}

TEST_F(MotionFile, RoundTrips) {
  const Instance first = instance(
      R"([{"id": "a", "start": [1, 0], "motion": "turning", "heading": "W",
           "working": {"task": "t", "done": 0}},
          {"id": "b", "start": [2, 1, "N", "E", 2], "goal": [0, 0], "motion": "turning",
           "turn_steps": 3, "goal_heading": "E"}])",
      kWork);
  write_instance(directory_.path() / "w.json", first, "m.map");
  const Instance restored = read_instance(directory_.path() / "w.json").instance;
  for (AgentIndex i = 0; i < 2; ++i) {
    EXPECT_EQ(restored.agent(i).start, first.agent(i).start);
    EXPECT_EQ(restored.agent(i).goal_heading, first.agent(i).goal_heading);
    EXPECT_EQ(restored.agent(i).motion, first.agent(i).motion);
  }
  EXPECT_EQ(restored.task(0).duration, 3);
  EXPECT_EQ(restored.world().state_count(), first.world().state_count());
}

TEST_F(MotionFile, InvalidValuesAreRefusedWithThePlace) {
  const auto agent = [](const std::string& rest) { return "i.json: /agents/0/" + rest; };
  struct Case {
    std::string members;
    std::string expected;
  };
  const std::string start = R"("start": [0, 0], )";
  const std::string turning = start + kTurns;
  const std::vector<Case> cases{
      {start + R"("motion": "omni")",
       R"(motion: found "omni"; expected "turning", or no such key for an agent that turns freely)"},
      {start + R"("motion": true)",
       R"(motion: found true; expected "turning", or no such key for an agent that turns freely)"},
      {start + R"("heading": "N")",
       R"(heading: found "N"; expected no such key without "motion": "turning")"},
      {start + R"("goal": [2, 0], "goal_heading": "N")",
       R"(goal_heading: found "N"; expected no such key without "motion": "turning")"},
      {start + R"("turn_steps": 2)",
       R"(turn_steps: found 2; expected no such key without "motion": "turning")"},
      {turning + R"("turn_steps": 0, "heading": "N")",
       "turn_steps: found 0; expected an integer from 1 to 65536"},
      {turning + R"("turn_steps": 1.5, "heading": "N")",
       "turn_steps: found 1.5; expected an integer from 1 to 65536"},
      {turning + R"("turn_steps": -1, "heading": "N")",
       "turn_steps: found -1; expected an integer from 1 to 65536"},
      {turning + R"("turn_steps": "2", "heading": "N")",
       "turn_steps: found \"2\"; expected an integer from 1 to 65536"},
      {turning + R"("goal": [2, 0])", "key 'heading' is missing; expected it in this object"},
      {turning + R"("heading": "n")", R"(heading: found "n"; expected "N", "E", "S" or "W")"},
      {turning + R"("heading": "NE")", R"(heading: found "NE"; expected "N", "E", "S" or "W")"},
      {turning + R"("heading": 90)", R"(heading: found 90; expected "N", "E", "S" or "W")"},
      {turning + R"("heading": null)", R"(heading: found null; expected "N", "E", "S" or "W")"},
      {turning + R"("heading": "N", "goal": [2, 0], "goal_heading": "Q")",
       R"(goal_heading: found "Q"; expected "N", "E", "S" or "W")"},
      {turning + R"("heading": "N", "goal_heading": "N")",
       "goal_heading: the agent has no goal; expected a goal, or no such key"},
      {turning + R"("heading": "N", "goal": [2, 0, "N"])",
       "goal: found an array; expected a cell [x, y]"},
      {R"("start": [1, 1], "motion": "turning", "heading": "N")",
       "start: cell [1, 1] is blocked on the map; expected a passable cell"},
      {R"("start": [0, 0, "N"])", "start: found an array; expected a cell [x, y]"},
      {R"("start": [0, 0, "X"], "motion": "turning")",
       R"(start/2: found "X"; expected "N", "E", "S" or "W")"},
      {R"("start": [0, 0, "N"], "motion": "turning", "heading": "E")",
       R"(heading: the start has "N"; expected the same, or no such key)"},
      {R"("start": [0, 0, "N", "S", 1], "motion": "turning", "turn_steps": 2)",
       "start/3: found \"S\"; expected the heading a quarter turn to the right or to the left"},
      {R"("start": [0, 0, "N", "E", 1], "motion": "turning")",
       "start: found a turn, but a quarter turn of this agent takes one step; expected [x, y, "
       "heading]"},
      {R"("start": [0, 0, "N", "E", 2], "motion": "turning", "turn_steps": 2)",
       "start/4: found 2; expected an integer from 1 to 1"},
      {R"("start": [0, 0, "N", "E", 0], "motion": "turning", "turn_steps": 2)",
       "start/4: found 0; expected an integer from 1 to 1"},
      {R"("start": [9, 0, "N"], "motion": "turning")",
       "start: cell [9, 0] is outside the map; expected x in 0..3 and y in 0..1"},
      {R"("start": [0, -1, "N"], "motion": "turning")",
       "start/1: found -1; expected an integer from 0 to 2147483647"},
      {start + R"("working": 3)", R"(working: found 3; expected {"task": ID, "done": STEPS})"},
      {start + R"("working": {"done": 1})",
       "working: key 'task' is missing; expected it in this object"},
      {start + R"("working": {"task": "t"})",
       "working: key 'done' is missing; expected it in this object"},
      {start + R"("working": {"task": 7, "done": 1})", "working/task: found 7; expected a string"},
      {start + R"("working": {"task": "t", "done": -1})",
       "working/done: found -1; expected an integer from 0 to 65536"},
      {start + R"("working": {"task": "z", "done": 1})",
       "working/task: there is no task 'z'; expected a task of agent 'a'"},
      {start + R"("working": {"task": "t", "done": 1})",
       "working/task: agent 'a' does not start on cell [1, 0]; expected a task on its start"},
      {R"("start": [1, 0], "working": {"task": "t", "done": 3})",
       "working/done: found 3 steps of task 't'; expected 0 to 2, less than its duration"},
      {R"("start": [1, 0], "working": {"task": "u", "done": 0})",
       "working/task: task 'u' takes no time; expected a task with a duration"},
  };
  for (const Case& c : cases) {
    const bool is_missing = c.expected.starts_with("key");
    EXPECT_EQ(refused_agent(c.members),
              is_missing ? "i.json: /agents/0: " + c.expected : agent(c.expected));
  }
  EXPECT_EQ(refusal([&] {
              instance(R"([{"id": "a", "start": [0, 0]},
                           {"id": "b", "start": [1, 0], "working": {"task": "t", "done": 1}}])",
                       kWork);
            }),
            "i.json: /agents/1/working/task: task 't' is not a task of agent 'b'; expected one of "
            "its tasks");
  EXPECT_EQ(refused_on_roads(R"("motion": "turning", "heading": "N")"),
            "i.json: /agents/0/motion: agents can turn only on grids; expected no such key on a "
            "roadmap");
  const std::string duration = "i.json: /tasks/0/duration: found ";
  for (const std::string wrong : {"-1", "1.5", "65537", "\"3\"", "null", "true"})
    EXPECT_EQ(refused_task("\"duration\": " + wrong),
              duration + wrong + "; expected an integer from 0 to 65536");
}

// A reader that ignored a misplaced key would return a different instance from the one that the
// author meant.
TEST_F(MotionFile, KeysInTheWrongPlaceAreRefused) {
  EXPECT_EQ(
      refused_agent(R"("start": [0, 0], "duration": 3)"),
      "i.json: /agents/0: unknown key 'duration'; this key belongs to a task; expected it there");
  EXPECT_EQ(
      refused_task(R"("heading": "N")"),
      "i.json: /tasks/0: unknown key 'heading'; this key belongs to an agent; expected it there");
  EXPECT_EQ(refusal([&] {
              instance(R"([{"id": "a", "start": [0, 0]}])", "[]",
                       R"("map": "m.map", "motion": "turning")");
            }),
            "i.json: /: unknown key 'motion'; this key belongs to an agent; expected it there");
}

TEST_F(MotionFile, WorldsWithTooManyStatesAreRefused) {
  EXPECT_EQ(refused_agent(R"("start": [0, 0], "motion": "turning", "heading": "N",
                             "turn_steps": 65536)",
                          kWork),
            "accepted");
  std::string wide = "type octile\nheight 100\nwidth 100\nmap\n";
  for (int row = 0; row < 100; ++row) wide += std::string(100, '.') + "\n";
  write("m.map", wide);
  EXPECT_EQ(refused_agent(R"("start": [0, 0], "motion": "turning", "heading": "N",
                             "turn_steps": 65536)",
                          "[]"),
            "i.json: /map: a world has at most 268435456 states");
}

TEST_F(MotionFile, PlansHoldHeadingsAndWork) {
  const Instance given = instance(
      R"([{"id": "a", "start": [0, 0], "goal": [1, 0], "motion": "turning", "heading": "N",
           "goal_heading": "S"}, {"id": "b", "start": [2, 0]}])",
      kWork);
  const std::string good =
      R"([{"id": "a", "sequence": ["u", "t"], "cost": 6,
           "work": [{"task": "t", "begin": 2, "end": 5}],
           "path": [[0,0,"N"],[0,0,"E"],[1,0,"E"],[1,0,"E"],[1,0,"E"],[1,0,"E"],[1,0,"S"]]},
          {"id": "b", "sequence": ["u"], "cost": 8, "path": [[2,0],[2,0],[2,0],[2,0],[2,0],[2,0],
           [2,0],[2,0],[1,0]]}])";
  // Both agents end on the same cell, which is the only violation.
  const auto violations = check(given, solution(given, good, 14));
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].message, "agents 'a' and 'b' are both on [1, 0] at time 8");
}

TEST_F(MotionFile, WorkMayBeListedInAnyOrder) {
  const Instance given = instance(R"([{"id": "a", "start": [0, 0], "goal": [1, 0]}])",
                                  R"([{"id": "s", "cell": [0, 0], "agents": ["a"], "duration": 1},
                                      {"id": "t", "cell": [1, 0], "agents": ["a"], "duration": 2}])");
  const Solution read = solution(given, R"([{"id": "a", "sequence": ["s", "t"], "cost": 4,
      "work": [{"task": "t", "begin": 2, "end": 4}, {"task": "s", "begin": 0, "end": 1}],
      "path": [[0,0],[0,0],[1,0],[1,0],[1,0]]}])",
                                 4);
  EXPECT_TRUE(check(given, read).empty());
  const std::vector<WorkTime> in_order{{0, 0, 1}, {1, 2, 4}};
  EXPECT_EQ(read.plan->agents[0].work, in_order);
}

}  // namespace motion_file_test
}  // namespace grove::detail
