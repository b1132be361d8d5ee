// SPDX-License-Identifier: MIT
// Tests files of roadmaps, of instances on them, and of their plans.
#include "io/roadmap_file.h"

#include <fmt/format.h>
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
namespace roadmap_file_test {

const std::string kRoads = R"({
 "vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [3.5, 0]}, {"id": "C", "at": [3.5, -2]}],
 "edges": [{"from": "A", "to": "B", "steps": 3},
           {"from": "B", "to": "C", "steps": 2, "one_way": true},
           {"from": "C", "to": "B", "steps": 2, "one_way": true}]})";

class RoadmapFile : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(directory_.path() / name) << text;
  }
  Instance instance(const std::string& agents, const std::string& tasks = "[]") {
    write("r.roadmap.json", kRoads);
    write("i.json",
          R"({"roadmap": "r.roadmap.json", "agents": )" + agents + R"(, "tasks": )" + tasks + "}");
    return read_instance(directory_.path() / "i.json").instance;
  }
  std::string refused_instance(const std::string& agents, const std::string& tasks = "[]") {
    return refusal([&] { instance(agents, tasks); });
  }
  std::string refused_roads(const std::string& text) {
    return refusal([&] { parse_roadmap(text, "r.json"); });
  }
  std::string refused_entry(const Instance& instance, const std::string& entry) {
    return refusal([&] {
      parse_solution(
          R"({"status": "feasible", "cost": 0, "lower_bound": 0, "omega": 0, "agents": [)"
          R"({"id": "a", "sequence": [], "cost": 0, "path": [)" +
              entry + "]}]}",
          "p.json", instance);
    });
  }

  TemporaryDirectory directory_;
};

TEST_F(RoadmapFile, RoundTrips) {
  const Roadmap read = parse_roadmap(kRoads, "r.json");
  EXPECT_EQ(read.place_count(), 3 + 2 + 1 + 1);
  write_roadmap(directory_.path() / "w.json", read);
  const Roadmap restored = read_roadmap(directory_.path() / "w.json");
  ASSERT_EQ(restored.vertices().size(), 3u);
  EXPECT_EQ(restored.vertices()[1].at, (Point{3.5, 0}));
  ASSERT_EQ(restored.roads().size(), 3u);
  EXPECT_EQ(restored.roads()[0].steps, 3);
  EXPECT_FALSE(restored.roads()[0].one_way);
  EXPECT_TRUE(restored.roads()[2].one_way);
}

TEST_F(RoadmapFile, RefusesARoadFromAVertexToItself) {
  EXPECT_EQ(refused_roads(R"({"vertices": [{"id": "A", "at": [0, 0]}], "edges": [)"
                          R"({"from": "A", "to": "A", "steps": 3}]})"),
            "r.json: /edges/0: from and to are the same vertex; expected two different ones");
}

TEST_F(RoadmapFile, RefusesInvalidValuesWithThePlace) {
  const auto vertices = [&](const std::string& list) {
    return refused_roads(R"({"edges": [], "vertices": )" + list + "}");
  };
  EXPECT_EQ(refused_roads(R"({"edges": []})"),
            "r.json: /: key 'vertices' is missing; expected it in this object");
  EXPECT_EQ(vertices("[]"), "r.json: /vertices: expected at least one vertex");
  EXPECT_EQ(vertices("7"), "r.json: /vertices: found 7; expected an array");
  EXPECT_EQ(vertices(R"([{"at": [0, 0]}])"),
            "r.json: /vertices/0: key 'id' is missing; expected it in this object");
  EXPECT_EQ(vertices(R"([{"id": 3, "at": [0, 0]}])"),
            "r.json: /vertices/0/id: found 3; expected a string");
  EXPECT_EQ(vertices(R"([{"id": "", "at": [0, 0]}])"),
            "r.json: /vertices/0/id: expected an id that is not empty");
  EXPECT_EQ(vertices(R"([{"id": "A", "at": [0, 0]}, {"id": "A", "at": [0, 0]}])"),
            "r.json: /vertices/1/id: id 'A' is used twice; expected distinct ids");
  EXPECT_EQ(vertices(R"([{"id": "A"}])"),
            "r.json: /vertices/0: key 'at' is missing; expected it in this object");
  EXPECT_EQ(vertices(R"([{"id": "A", "at": [0]}])"),
            "r.json: /vertices/0/at: found an array; expected [x, y] in metres");
  EXPECT_EQ(vertices(R"([{"id": "A", "at": [0, "1"]}])"),
            "r.json: /vertices/0/at/1: found \"1\"; expected a number");

  const auto edge = [&](const std::string& text) {
    return refused_roads(
        R"({"vertices": [{"id": "A", "at": [0, 0]}, {"id": "B", "at": [1, 0]}], "edges": [)" +
        text + "]}");
  };
  EXPECT_EQ(edge(R"({"to": "B", "steps": 1})"),
            "r.json: /edges/0: key 'from' is missing; expected it in this object");
  EXPECT_EQ(edge(R"({"from": "X", "to": "B", "steps": 1})"),
            "r.json: /edges/0/from: there is no vertex 'X'; expected the id of one of this file");
  EXPECT_EQ(edge(R"({"from": "A", "to": ["B"], "steps": 1})"),
            "r.json: /edges/0/to: found an array; expected a string");
  EXPECT_EQ(edge(R"({"from": "A", "to": "B"})"),
            "r.json: /edges/0: key 'steps' is missing; expected it in this object");
  EXPECT_EQ(edge(R"({"from": "A", "to": "B", "steps": 0})"),
            "r.json: /edges/0/steps: found 0; expected an integer from 1 to 67108864");
  EXPECT_EQ(
      edge(R"({"from": "A", "to": "B", "steps": 2.5})"),
      "r.json: /edges/0/steps: found 2.5; expected a whole number of steps, at least 1; 'grove "
      "convert --metres-per-step' converts lengths in GraphML or LIF to steps, rounded up");
  EXPECT_EQ(edge(R"({"from": "A", "to": "B", "steps": 1, "one_way": 1})"),
            "r.json: /edges/0/one_way: found 1; expected true or false");
  EXPECT_TRUE(edge(R"({"from": "A", "to": "B", "steps": 67108864})")
                  .starts_with("r.json: /edges/0: the roads up to this one have more than"));
}

TEST_F(RoadmapFile, AgentsStartAnywhereAndEndAtVertices) {
  const Instance on = instance(
      R"([{"id": "a", "start": ["A", "B", 1], "goal": "C"}, {"id": "b", "start": "A"},
          {"id": "c", "start": ["B", "A", 1], "goal": ["A"]}])",
      R"([{"id": "t", "cell": "B", "agents": ["a", "b"]}])");
  EXPECT_EQ(on.agent(0).start, on.roadmap()->place_on_road(0, 1));
  EXPECT_EQ(on.agent(1).start, 0);
  EXPECT_EQ(on.agent(2).start, on.roadmap()->place_on_road(0, 2));
  EXPECT_EQ(on.agent(2).goal, 0);
  EXPECT_EQ(on.task(0).cell, 1);

  write_instance(directory_.path() / "restored.json", on, "r.roadmap.json");
  const Instance restored = read_instance(directory_.path() / "restored.json").instance;
  for (AgentIndex agent = 0; agent < 3; ++agent) {
    EXPECT_EQ(restored.agent(agent).start, on.agent(agent).start);
    EXPECT_EQ(restored.agent(agent).goal, on.agent(agent).goal);
  }
}

TEST_F(RoadmapFile, InvalidPlacesOfInstancesAreRefused) {
  const auto start = [&](const std::string& text) {
    return refused_instance(R"([{"id": "a", "goal": "C", "start": )" + text + "}]");
  };
  EXPECT_EQ(start("\"X\""),
            "i.json: /agents/0/start: there is no vertex 'X'; expected one of the roadmap");
  EXPECT_EQ(start("[0, 0]"),
            "i.json: /agents/0/start: found an array; expected a vertex [\"A\"] or "
            "a place on a road [\"A\", \"B\", k], k steps from A");
  EXPECT_EQ(start("3"),
            "i.json: /agents/0/start: found 3; expected a vertex [\"A\"] or a place on "
            "a road [\"A\", \"B\", k], k steps from A");
  EXPECT_EQ(start(R"(["A", "C", 1])"),
            "i.json: /agents/0/start: no road joins these vertices; expected two vertices joined "
            "by a road");
  EXPECT_EQ(start(R"(["A", "B", 3])"),
            "i.json: /agents/0/start/2: found 3; expected an integer from 1 to 2");
  EXPECT_EQ(start(R"(["B", "C", 1])"),
            "i.json: /agents/0/start: 2 roads join these vertices; expected a fourth entry, the "
            "number of the edge in the roadmap (from 0)");
  EXPECT_EQ(start(R"(["B", "C", 1, 0])"),
            "i.json: /agents/0/start/3: edge 0 does not join these vertices; expected one that "
            "does");
  EXPECT_EQ(start(R"(["B", "C", 1, 3])"),
            "i.json: /agents/0/start/3: found 3; expected an integer from 0 to 2");
  EXPECT_EQ(refused_instance(R"([{"id": "a", "start": "A", "goal": ["A", "B", 1]}])"),
            "i.json: /agents/0/goal: found an array; expected the id of a vertex");
  EXPECT_EQ(refused_instance(R"([{"id": "a", "start": "A", "goal": "C"}])",
                             R"([{"id": "t", "cell": [1, 1], "agents": ["a"]}])"),
            "i.json: /tasks/0/cell: found an array; expected the id of a vertex");
  EXPECT_EQ(refused_instance(R"([{"id": "a", "start": "A", "goal": "C"},
                                 {"id": "b", "start": "A", "goal": "B"}])"),
            "i.json: /agents/1/start: place [\"A\"] is already the start of agent 'a'; expected "
            "distinct starts");
}

TEST_F(RoadmapFile, InstanceHasEitherAMapOrARoadmap) {
  write("r.roadmap.json", kRoads);
  const auto refused = [&](const std::string& text) {
    return refusal([&] { parse_instance(text, "i.json", directory_.path()); });
  };
  EXPECT_EQ(refused(R"({"map": "x.map", "roadmap": "r.roadmap.json", "agents": [], "tasks": []})"),
            "i.json: /: found both 'map' and 'roadmap'; expected one of them");
  EXPECT_TRUE(refused(R"({"roadmap": "none.json", "agents": [], "tasks": []})")
                  .starts_with("i.json: /roadmap: there is no file"));
  EXPECT_EQ(refused(R"({"roadmap": 1, "agents": [], "tasks": []})"),
            "i.json: /roadmap: found 1; expected a string");
}

TEST_F(RoadmapFile, PlansNameThePlacesOnRoads) {
  const Instance on = instance(R"([{"id": "a", "start": "A", "goal": "C"}])");
  Solution solution;
  solution.status = Status::kOptimal;
  solution.lower_bound = 5;
  const Roadmap& roads = *on.roadmap();
  solution.plan = Plan{5,
                       {{5,
                         {},
                         {0, roads.place_on_road(0, 1), roads.place_on_road(0, 2), 1,
                          roads.place_on_road(1, 1), 2}}}};
  const std::string text = solution_text(on, solution);
  EXPECT_NE(text.find(R"([["A"],["A","B",1],["A","B",2],["B"],["B","C",1,1],["C"]])"),
            std::string::npos)
      << text;
  const Solution restored = parse_solution(text, "p.json", on);
  EXPECT_EQ(restored.plan->agents[0].path, solution.plan->agents[0].path);
  EXPECT_TRUE(check(on, restored).empty());
  EXPECT_EQ(parse_solution(text, "p.json", on).plan->cost, 5);
}

TEST_F(RoadmapFile, CheckerRefusesMovesAgainstOneWayRoads) {
  const Instance on = instance(R"([{"id": "a", "start": "C", "goal": "B"}])");
  const Roadmap& roads = *on.roadmap();
  Solution solution;
  solution.status = Status::kOptimal;
  solution.lower_bound = 2;
  solution.plan = Plan{2, {{2, {}, {2, roads.place_on_road(2, 1), 1}}}};
  EXPECT_TRUE(check(on, solution).empty());
  solution.plan->agents[0].path[1] = roads.place_on_road(1, 1);  // against its direction
  const auto violations = check(on, solution);
  ASSERT_EQ(violations.size(), 2u);
  EXPECT_EQ(
      violations[0].message,
      "agent 'a' jumps from [\"C\"] to [\"B\", \"C\", 1, 1]; expected a wait or a step along a "
      "road in its direction");
}

TEST_F(RoadmapFile, InvalidPathEntriesAreRefused) {
  const Instance on = instance(R"([{"id": "a", "start": "A", "goal": "C"}])");
  EXPECT_EQ(refused_entry(on, "[\"X\"]"),
            "p.json: /agents/0/path/0/0: there is no vertex 'X'; expected one of the roadmap");
  EXPECT_EQ(refused_entry(on, "\"A\""),
            "p.json: /agents/0/path/0: found \"A\"; expected a vertex [\"A\"] or a place on a road "
            "[\"A\", \"B\", k], k steps from A");
  EXPECT_EQ(refused_entry(on, R"(["A", "B", 0])"),
            "p.json: /agents/0/path/0/2: found 0; expected an integer from 1 to 2");
}

}  // namespace roadmap_file_test
}  // namespace grove::detail
