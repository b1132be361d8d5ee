// SPDX-License-Identifier: MIT
// Tests instance files in which agents choose tasks and destinations.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "io/instance_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace choices_file_test {

const std::string kAgents = R"([{"id": "a", "start": [0, 0], "goals": [[3, 0], [0, 1]]},
                                {"id": "b", "start": [1, 0], "goal": [2, 0]},
                                {"id": "c", "start": [2, 0]}])";

class ChoicesFile : public ::testing::Test {
 protected:
  ChoicesFile() {
    std::ofstream(directory_.path() / "m.map")
        << "type octile\nheight 2\nwidth 4\nmap\n....\n.@..\n";
    std::ofstream(directory_.path() / "r.roadmap.json") << R"({
 "vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [3, 0]}],
 "edges": [{"from": "A", "to": "B", "steps": 3}]})";
  }
  Instance read(const std::string& agents, const std::string& tasks,
                const std::string& map = R"("map": "m.map")") {
    const std::string text =
        "{" + map + R"(, "agents": )" + agents + R"(, "tasks": )" + tasks + "}";
    return parse_instance(text, "i.json", directory_.path()).instance;
  }
  std::string refused_agent(const std::string& members) {
    return refusal([&] { read(R"([{"id": "a", "start": [0, 0], )" + members + "}]", "[]"); });
  }
  std::string refused_task(const std::string& members) {
    return refusal([&] { read(kAgents, R"([{"id": "t", "cell": [1, 0], )" + members + "}]"); });
  }
  TemporaryDirectory directory_;
};

TEST_F(ChoicesFile, ReadsChoices) {
  const Instance instance =
      read(kAgents, R"([{"id": "t", "cell": [1, 0], "agents": "*", "need": 2, "duration": 3},
                        {"id": "u", "cell": [2, 0], "agents": ["a", "c"], "need": 1},
                        {"id": "v", "cell": [0, 0], "agents": "*"}])");
  EXPECT_EQ(instance.agent(0).goals, (std::vector<Place>{3, 4}));
  EXPECT_EQ(instance.agent(0).goal, std::nullopt);
  EXPECT_EQ(instance.task(0).agents, (std::vector<AgentIndex>{0, 1, 2}));
  EXPECT_EQ(instance.task(0).need, 2);
  EXPECT_EQ(instance.agent(2).options, (std::vector<TaskIndex>{0, 1}));
  EXPECT_EQ(instance.agent(2).tasks, (std::vector<TaskIndex>{2}));
}

TEST_F(ChoicesFile, WritesWhatItReads) {
  const Instance instance =
      read(kAgents, R"([{"id": "t", "cell": [1, 0], "agents": "*", "need": 2, "duration": 3},
                        {"id": "u", "cell": [2, 0], "agents": ["a", "c"], "need": 1}])");
  const std::string text = instance_text(instance, "m.map");
  EXPECT_NE(text.find(R"("goals":[[3,0],[0,1]])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("agents":"*","need":2,"duration":3)"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("agents":["a","c"],"need":1)"), std::string::npos) << text;
  EXPECT_EQ(instance_text(parse_instance(text, "i.json", directory_.path()).instance, "m.map"),
            text);
}

TEST_F(ChoicesFile, GoalsOnARoadmap) {
  const Instance instance = read(R"([{"id": "a", "start": "A", "goals": ["B", ["A"]]}])", "[]",
                                 R"("roadmap": "r.roadmap.json")");
  EXPECT_EQ(instance.agent(0).goals, (std::vector<Place>{1, 0}));
}

TEST_F(ChoicesFile, RefusesBadGoals) {
  EXPECT_EQ(
      refused_agent(R"("goals": [])"),
      "i.json: /agents/0/goals: found an empty list; expected a list of at least one place, or "
      "no such key");
  EXPECT_EQ(refused_agent(R"("goals": [3, 0])"),
            "i.json: /agents/0/goals: found one cell; expected a list of cells [x, y], or the key "
            "'goal' for one cell");
  EXPECT_EQ(refused_agent(R"("goal": [[3, 0], [2, 0]])"),
            "i.json: /agents/0/goal: found a list of places; expected one place, or the key "
            "'goals' for a choice");
  EXPECT_EQ(refused_agent(R"("goals": "*")"),
            "i.json: /agents/0/goals: found \"*\"; expected a list of at least one place");
  EXPECT_EQ(refused_agent(R"("goals": null)"),
            "i.json: /agents/0/goals: found null; expected a list of at least one place");
  EXPECT_EQ(refused_agent(R"("goals": [[3, 0], [1, 1]])"),
            "i.json: /agents/0/goals/1: cell [1, 1] is blocked on the map; expected a passable "
            "cell");
  EXPECT_EQ(refused_agent(R"("goals": [[3, 0], [9, 1]])"),
            "i.json: /agents/0/goals/1: cell [9, 1] is outside the map; expected x in 0..3 and y "
            "in 0..1");
  EXPECT_EQ(refused_agent(R"("goals": [[3, 0], [3, 0]])"),
            "i.json: /agents/0/goals/1: cell [3, 0] is listed twice; expected each place once");
  EXPECT_EQ(refused_agent(R"("goal": [3, 0], "goals": [[2, 0]])"),
            "i.json: /agents/0/goals: found both 'goal' and 'goals'; expected one of them");
  EXPECT_EQ(refused_agent(R"("targets": [[2, 0]])"),
            "i.json: /agents/0: unknown key 'targets'; expected 'goals', if that is meant");
}

TEST_F(ChoicesFile, RefusesBadNeeds) {
  EXPECT_EQ(refused_task(R"("agents": "*", "need": 0)"),
            "i.json: /tasks/0/need: found 0; expected an integer from 1 to 3, the number of agents "
            "of the task");
  EXPECT_EQ(refused_task(R"("agents": "*", "need": 4)"),
            "i.json: /tasks/0/need: found 4; expected an integer from 1 to 3, the number of agents "
            "of the task");
  EXPECT_EQ(refused_task(R"("agents": ["a"], "need": 1.5)"),
            "i.json: /tasks/0/need: found 1.5; expected an integer from 1 to 1, the number of "
            "agents of the task");
  EXPECT_EQ(refused_task(R"("agents": ["a"], "need": "1")"),
            "i.json: /tasks/0/need: found \"1\"; expected an integer from 1 to 1, the number of "
            "agents of the task");
  EXPECT_EQ(refused_task(R"("agents": "all", "need": 1)"),
            "i.json: /tasks/0/agents: found \"all\"; expected a list of ids, or \"*\" for all "
            "agents");
  EXPECT_EQ(refused_task(R"("agents": ["*"], "need": 1)"),
            "i.json: /tasks/0/agents/0: there is no agent '*'; expected \"agents\": \"*\", without "
            "brackets, for all agents");
}

TEST_F(ChoicesFile, AnAgentMayHaveTheIdStar) {
  const Instance instance = read(R"([{"id": "*", "start": [0, 0]}, {"id": "b", "start": [1, 0]}])",
                                 R"([{"id": "t", "cell": [1, 0], "agents": ["*"]}])");
  EXPECT_EQ(instance.task(0).agents, (std::vector<AgentIndex>{0}));
}

TEST_F(ChoicesFile, RefusesAListOfVerticesAsGoal) {
  const std::string on_roads = R"("roadmap": "r.roadmap.json")";
  const auto refused = [&](const std::string& goal) {
    return refusal(
        [&] { read(R"([{"id": "a", "start": "A", "goal": )" + goal + "}]", "[]", on_roads); });
  };
  EXPECT_EQ(refused(R"(["A", "B"])"),
            "i.json: /agents/0/goal: found a list of places; expected one place, or the key "
            "'goals' for a choice");
  EXPECT_EQ(refused(R"(["B"])"), "accepted");
}

// Returns the hints on an instance with these tasks.
std::vector<std::string> hints(const TemporaryDirectory& directory, const std::string& tasks) {
  const std::string text =
      R"({"map": "m.map", "agents": )" + kAgents + R"(, "tasks": )" + tasks + "}";
  return parse_instance(text, "i.json", directory.path()).hints;
}

TEST_F(ChoicesFile, HintsAtTasksForAllAgentsWithoutANeed) {
  const std::string task = R"({"id": "t", "cell": [1, 0], "agents": "*"})";
  const std::string other = R"({"id": "u", "cell": [1, 0], "agents": "*"})";
  const std::string start =
      "i.json: /tasks/0: \"agents\": \"*\" without \"need\" means that all 3 agents must visit the "
      "task";
  const std::string end = "; if any one of them may do so, add \"need\": 1";
  EXPECT_EQ(hints(directory_, "[" + task + "]"), (std::vector<std::string>{start + end}));
  EXPECT_EQ(hints(directory_, "[" + task + "," + other + "]"),
            (std::vector<std::string>{start + " (the first of 2 such tasks)" + end}));
  for (const char* tasks : {"[]", R"([{"id": "t", "cell": [1, 0], "agents": "*", "need": 3}])",
                            R"([{"id": "t", "cell": [1, 0], "agents": ["a", "b", "c"]}])"})
    EXPECT_TRUE(hints(directory_, tasks).empty()) << tasks;
}

}  // namespace choices_file_test
}  // namespace grove::detail
