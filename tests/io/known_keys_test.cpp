// SPDX-License-Identifier: MIT
// Tests the known keys of each object in Grove's own files, and the messages for unknown keys.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/change_file.h"
#include "io/input_error.h"
#include "io/instance_file.h"
#include "io/plan_file.h"
#include "io/roadmap_file.h"
#include "io/solver_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace known_keys_test {

// In each text '~' marks a position where a key can be inserted.
const std::string kInstance = R"({~"map": "m.map",
  "agents": [{~"id": "a", "start": [0, 0], "goal": [2, 0], "working": {~"task": "w", "done": 1}}],
  "tasks": [{~"id": "w", "cell": [0, 0], "agents": ["a"], "duration": 2}]})";
const std::string kRobots = R"({~"agents": [{~"id": "a", "start": [0, 0]}], "tasks": []})";
const std::string kRoadmap = R"({~"vertices": [{~"id": "A", "at": [0, 0]},
  {"id": "B", "at": [1, 0]}], "edges": [{~"from": "A", "to": "B", "steps": 1}]})";
const std::string kPlan = R"({~"status": "feasible", "cost": 4, "lower_bound": 0, "omega": 0,
  "agents": [{~"id": "a", "sequence": ["w"], "cost": 4, "path": [[0, 0]],
              "work": [{~"task": "w", "begin": -1, "end": 1}]}]})";
const std::string kNewTasks = R"({~"tasks": [{~"id": "n", "cell": [2, 1], "agents": ["a"]}]})";
const std::string kNewTask = R"({~"id": "n", "cell": [2, 1], "agents": ["a"]})";
const std::string kSolver = R"json({~"name": "s", "command": "{program} {map} {scenario}",
  "claims": {~"cost": {~"regex": "(.)"}},
  "trace": [{~"regex": "(.)(.)", "groups": ["cost", "seconds"]}]})json";

// Returns `text` with `member` inserted at marked position `number`, or "" if there are fewer
// positions. If `number` is negative, nothing is inserted.
std::string with(const std::string& text, int number, const std::string& member) {
  std::string made;
  int count = 0;
  for (const char c : text) {
    if (c != '~')
      made += c;
    else if (count++ == number)
      made += member + ", ";
  }
  return number < count || number < 0 ? made : "";
}

class KnownKeys : public ::testing::Test {
 protected:
  KnownKeys() { directory_.write("m.map", "type octile\nheight 2\nwidth 3\nmap\n...\n...\n"); }

  std::string refused(const std::string& kind, const std::string& text) {
    return refusal([&] {
      const auto instance = [&] {
        return parse_instance(with(kInstance, -1, ""), "i", directory_.path()).instance;
      };
      if (kind == "instance") parse_instance(text, "f", directory_.path());
      if (kind == "robots") parse_instance_on(InstanceBuilder(instance().map()), text, "f");
      if (kind == "roadmap") parse_roadmap(text, "f");
      if (kind == "plan") parse_solution(text, "f", instance());
      if (kind == "tasks") read_new_tasks(directory_.write("f", text), instance());
      if (kind == "solver") parse_solver(text, "f");
    });
  }
  std::string refused_member(const std::string& text, int number, const std::string& member) {
    return refused("instance", with(text, number, member));
  }
  std::string refused_edge(const std::string& member) {
    return refused("roadmap", with(kRoadmap, 2, member));
  }

  TemporaryDirectory directory_;
};

struct File {
  std::string kind;
  std::string text;
  std::vector<std::string> objects;
};

TEST_F(KnownKeys, UnknownKeysAreRefusedInEveryObject) {
  const std::vector<File> files{
      {"instance", kInstance, {"/", "/agents/0", "/agents/0/working", "/tasks/0"}},
      {"robots", kRobots, {"/", "/agents/0"}},
      {"roadmap", kRoadmap, {"/", "/vertices/0", "/edges/0"}},
      {"plan", kPlan, {"/", "/agents/0", "/agents/0/work/0"}},
      {"tasks", kNewTasks, {"/", "/tasks/0"}},
      {"tasks", kNewTask, {"/"}},
      {"solver", kSolver, {"/", "/claims", "/claims/cost", "/trace/0"}}};
  for (const File& file : files) {
    EXPECT_EQ(refused(file.kind, with(file.text, -1, "")), "accepted") << file.kind;
    for (int k = 0; k < static_cast<int>(file.objects.size()); ++k) {
      const auto refused_here = [&](const std::string& member) {
        return refused(file.kind, with(file.text, k, member));
      };
      const std::string place = "f: " + file.objects[k] + ": unknown key 'xyz'; expected one of ";
      EXPECT_EQ(refused_here(R"("xyz": 1)").substr(0, place.size()), place) << file.kind;
      EXPECT_EQ(refused_here(R"("_xyz": {"xyz": 1}, "_": null, "$schema": "s.json")"), "accepted")
          << file.kind << " " << file.objects[k];
      EXPECT_NE(refused_here(R"("$other": 1)"), "accepted");
    }
    EXPECT_EQ(with(file.text, static_cast<int>(file.objects.size()), "x"), "") << file.kind;
  }
}

TEST_F(KnownKeys, CloseKeyIsSuggested) {
  const auto hint = [](const std::string& found, const std::string& meant) {
    return "unknown key '" + found + "'; expected " + meant + ", if that is meant";
  };
  const std::vector<std::vector<std::string>> cases{
      {"headin", "'heading'"}, {"turn-steps", "'turn_steps'"}, {"motions", "'motion'"},
      {"Motion", "'motion'"},  {"moiton", "'motion'"},         {"goal_haeding", "'goal_heading'"}};
  for (const auto& each : cases)
    EXPECT_EQ(refused_member(kInstance, 1, '"' + each[0] + "\": 1"),
              "f: /agents/0: " + hint(each[0], each[1]));
  std::string without_duration = kInstance;
  without_duration.replace(without_duration.find(", \"duration\": 2"), 15, "");
  for (const char* found : {"dur", "Duration", "durations", "druation", "time"})
    EXPECT_EQ(refused_member(without_duration, 3, '"' + std::string(found) + "\": 1"),
              "f: /tasks/0: " + hint(found, "'duration'"));
  for (const char* found : {"bidirectional", "directed", "oneway", "One-Way", "one_ways"})
    EXPECT_EQ(refused_edge('"' + std::string(found) + "\": true"),
              "f: /edges/0: " + hint(found, "'one_way' (true: only from 'from' to 'to')"));
  EXPECT_EQ(refused("roadmap", R"({"vertices": [{"id": "A", "position": [0, 0]}], "edges": []})"),
            "f: /vertices/0: " + hint("position", "'at'"));
  // This key belongs to a different object but is similar to a key of this one.
  EXPECT_EQ(refused("instance", R"({"map": "m.map", "agents": [], "task": []})"),
            "f: /: " + hint("task", "'tasks'"));
  EXPECT_EQ(refused("instance", R"({"map": "m.map", "agents": [{"id": "a", "start": [0, 0],
      "working": {"tasks": "w", "done": 1}}], "tasks": []})"),
            "f: /agents/0/working: " + hint("tasks", "'task'"));
  // The similar key is already used, so the message does not suggest it.
  EXPECT_EQ(
      refused_member(kInstance, 1, R"("gaol": [1, 1])"),
      "f: /agents/0: unknown key 'gaol'; expected one of id, start, goal, goals, motion, "
      "turn_steps, heading, goal_heading, working, or a name that begins with '_', for a remark");
}

TEST_F(KnownKeys, UnsupportedFeaturesAreNamed) {
  const std::vector<std::vector<std::string>> of_tasks{
      {"deadline", "deadlines"},  {"deadlines", "deadlines"},        {"priority", "priorities"},
      {"capacity", "capacities"}, {"after", "an order among tasks"}, {"window", "time windows"}};
  const auto message = [](const std::string& key, const std::string& what) {
    return "unknown key '" + key + "'; Grove does not model " + what + "; expected no such key";
  };
  for (const auto& each : of_tasks) {
    EXPECT_EQ(refused_member(kInstance, 3, '"' + each[0] + "\": 1"),
              "f: /tasks/0: " + message(each[0], each[1]));
    EXPECT_EQ(refused("tasks", with(kNewTasks, 1, '"' + each[0] + "\": 1")),
              "f: /tasks/0: " + message(each[0], each[1]));
  }
  EXPECT_EQ(refused("tasks", with(kNewTasks, 1, R"("need": 1)")), "accepted");
  EXPECT_EQ(refused_member(kInstance, 1, R"("finish_by": 9)"),
            "f: /agents/0: " + message("finish_by", "deadlines"));
  EXPECT_EQ(refused_member(kInstance, 0, R"("objective": "makespan")"),
            "f: /: " + message("objective", "objectives other than the sum of costs"));
  EXPECT_EQ(refused_member(kInstance, 0, R"("jobs": [])"), "f: /: " + message("jobs", "jobs"));
  EXPECT_EQ(refused_edge(R"("capacity": 2)"), "f: /edges/0: " + message("capacity", "capacities"));
}

TEST_F(KnownKeys, KeyOfAnotherObjectIsReferredThere) {
  EXPECT_EQ(refused_member(kInstance, 1, R"("duration": 3)"),
            "f: /agents/0: unknown key 'duration'; this key belongs to a task; expected it there");
  EXPECT_EQ(refused_member(kInstance, 3, R"("goal": [1, 1])"),
            "f: /tasks/0: unknown key 'goal'; this key belongs to an agent; expected it there");
  EXPECT_EQ(refused_member(kInstance, 0, R"("motion": "turning")"),
            "f: /: unknown key 'motion'; this key belongs to an agent; expected it there");
  EXPECT_EQ(refused("tasks", with(kNewTasks, 0, R"("id": "x")")),
            "f: /: unknown key 'id'; this key belongs to a task; expected it there");
  EXPECT_EQ(refused("plan", with(kPlan, 1, R"("begin": 0)")),
            "f: /agents/0: unknown key 'begin'; this key belongs to work; expected it there");
}

TEST_F(KnownKeys, FileOfAnotherKindIsNamed) {
  EXPECT_EQ(refused("instance", with(kPlan, -1, "")), "f: /: found a plan; expected an instance");
  EXPECT_EQ(refused("instance", with(kRoadmap, -1, "")),
            "f: /: found a roadmap; expected an instance");
  EXPECT_EQ(refused("plan", with(kInstance, -1, "")), "f: /: found an instance; expected a plan");
  EXPECT_EQ(refused("roadmap", with(kPlan, -1, "")), "f: /: found a plan; expected a roadmap");
}

TEST_F(KnownKeys, StatisticsOfAPlanMayHaveAnyKey) {
  EXPECT_EQ(refused("plan", with(kPlan, 0, R"("stats": {"xyz": 1, "goals": 2})")), "accepted");
}

TEST_F(KnownKeys, LongKeysAreQuotedInShortOnOneLine) {
  const std::string message =
      refused_member(kInstance, 0, '"' + std::string(5000, 'm') + R"(\n": 1)");
  EXPECT_EQ(message.substr(0, 22), "f: /: unknown key 'mmm");
  EXPECT_LT(message.size(), 900U);
}

}  // namespace known_keys_test
}  // namespace grove::detail
