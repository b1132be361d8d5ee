// SPDX-License-Identifier: MIT
#include "io/mapfw_file.h"

#include <gtest/gtest.h>

#include "io/format_support.h"
#include "tests/support/instances.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace mapfw_file_test {

// . @ . . .   Wider than high, and without symmetries.
// . . . . .
// . . . @ @
const std::vector<std::string> kMap = {".@...", ".....", "...@@"};
const std::string kProblem =
    "{\n \"grid\": [\n  [0,1,0,0,0],\n  [0,0,0,0,0],\n  [0,0,0,1,1]],\n"
    " \"width\": 5,\n \"height\": 3,\n \"starts\": [\n  [0,0],\n  [3,0]],\n"
    " \"goals\": [\n  [4,0],\n  [1,2]],\n \"waypoints\": [\n  [[2,1]],\n  [[0,1],[2,1]]]}\n";

// Both agents must visit task t0.
Instance instance(const std::string& last_task = "t1") {
  InstanceBuilder builder(testing::grid_of(kMap));
  builder.add_agent("a0", {0, 0}, Position{4, 0});
  builder.add_agent("a1", {3, 0}, Position{1, 2});
  builder.add_task("t0", {2, 1}, std::vector<std::string>{"a0", "a1"});
  builder.add_task(last_task, {0, 1}, std::vector<std::string>{"a1"});
  return std::move(builder).build();
}

class MapfwFile : public ::testing::Test {
 protected:
  std::string written(const Instance& i) {
    write_mapfw_problem(directory_ / "o.json", i);
    return file_content(directory_ / "o.json");
  }
  Instance read(const std::string& content) {
    return read_mapfw_problem(directory_.write("p.json", content), &warnings_);
  }
  std::string refused_with(const std::string& from, const std::string& to) {
    std::string text = kProblem;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    return refusal([&] { read(text); });
  }

  TemporaryDirectory directory_;
  std::vector<std::string> warnings_;
};

TEST_F(MapfwFile, ReadsCellsAsColumnAndRow) {
  const Instance read_back = read(kProblem);
  const Grid& grid = read_back.grid();
  EXPECT_EQ(grid.width(), 5);
  EXPECT_EQ(grid.height(), 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(grid.passable(grid.cell({x, y})), kMap[y][x] == '.') << x << " " << y;
  ASSERT_EQ(read_back.agent_count(), 2);
  EXPECT_EQ(read_back.agent(1).id, "a1");
  EXPECT_EQ(grid.position(read_back.agent(1).start), (Position{3, 0}));
  EXPECT_EQ(grid.position(*read_back.agent(1).goal), (Position{1, 2}));
  ASSERT_EQ(read_back.task_count(), 2);
  EXPECT_EQ(read_back.task(0).id, "t0");
  EXPECT_EQ(grid.position(read_back.task(0).cell), (Position{2, 1}));
  EXPECT_EQ(read_back.task(0).agents, (std::vector<AgentIndex>{0, 1}));
  EXPECT_EQ(grid.position(read_back.task(1).cell), (Position{0, 1}));
  EXPECT_EQ(read_back.task(1).agents, (std::vector<AgentIndex>{1}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(MapfwFile, ListsATaskForEachOfItsAgents) {
  // Agent a1 lists its waypoints in the order of the tasks, but that order has no meaning.
  std::string expected = kProblem;
  expected.replace(expected.find("[[0,1],[2,1]]"), 13, "[[2,1],[0,1]]");
  EXPECT_EQ(written(instance()), expected);
  EXPECT_EQ(written(read(expected)), expected);
  EXPECT_EQ(written(read(kProblem)), expected);
}

TEST_F(MapfwFile, ReadsAnyNonzeroNumberAsAnObstacle) {
  std::string text = kProblem;
  text.replace(text.find("[0,1,0"), 6, "[0,-7,0");
  EXPECT_EQ(written(read(text)), written(instance()));
}

TEST_F(MapfwFile, RefusesInvalidFilesWithThePlace) {
  EXPECT_EQ(refused_with("waypoints", "points"),
            "p.json: /: key 'waypoints' is missing; expected it in this object");
  EXPECT_EQ(refused_with("\"height\": 3", "\"height\": 2"),
            "p.json: /grid: has 3 entries; expected 2, one per row");
  EXPECT_EQ(refused_with("\"width\": 5", "\"width\": 99999999999"),
            "p.json: /width: found 99999999999; expected an integer from 1 to 67108864");
  EXPECT_EQ(refused_with("[0,0,0,1,1]", "[0,0,0,1]"),
            "p.json: /grid/2: has 4 entries; expected 5, one per column");
  EXPECT_EQ(refused_with("[0,0,0,1,1]", "[0,0,0,1,true]"),
            "p.json: /grid/2/4: found true; expected 0 for a passable cell, another integer for a "
            "blocked one");
  EXPECT_EQ(refused_with("[4,0],", ""), "p.json: /goals: has 1 entries; expected 2, one per start");
  EXPECT_EQ(refused_with("[[2,1]],", ""),
            "p.json: /waypoints: has 1 entries; expected 2, one per start");
  EXPECT_EQ(refused_with("[3,0]", "[-3,0]"),
            "p.json: /starts/1/0: found -3; expected an integer from 0 to 2147483647");
  EXPECT_EQ(refused_with("[3,0]", "[0,3]"),
            "p.json: /starts/1: cell [0, 3] is outside the map; expected [x, y] (column, row) with "
            "x in 0..4 and y in 0..2");
  EXPECT_EQ(refused_with("[1,2]", "[4,2]"),
            "p.json: /goals/1: cell [4, 2] is blocked on the map; expected a passable cell");
  EXPECT_EQ(refused_with("[1,2]", "[4,0]"),
            "p.json: /goals/1: cell [4, 0] is already the goal of agent 'a0'; expected distinct "
            "goals");
  EXPECT_EQ(refused_with("[0,1],[2,1]", "[2,1],[2,1]"),
            "p.json: /waypoints/1/1: agent 'a1' lists cell [2, 1] twice; expected distinct cells");
  EXPECT_EQ(refused_with("[0,1],[2,1]", "[0,1],[1,0]"),
            "p.json: /waypoints/1/1: cell [1, 0] is blocked on the map; expected a passable cell");
  EXPECT_EQ(refusal([&] {
              read(R"({"grid": [[0]], "width": 1, "height": 1, "starts": [], "goals": [],
                       "waypoints": []})");
            }),
            "p.json: /starts: expected at least one agent");
}

// Any one of the agents must visit the first task.
Instance with_a_need() {
  InstanceBuilder builder(testing::grid_of({"....."}));
  builder.add_agent("a0", {0, 0}, Position{4, 0});
  builder.add_agent("red", {1, 0}, Position{3, 0});
  builder.add_task("lift", {2, 0}, std::vector<std::string>{"a0", "red"}, 0, 1);
  builder.add_task("shelf", {2, 0}, std::vector<std::string>{"red"});
  return std::move(builder).build();
}

TEST_F(MapfwFile, UnrepresentableInstancesAreNotWritten) {
  const auto problem = [&](const Instance& i) -> std::string {
    try {
      return written(i);
    } catch (const NotRepresentable& error) {
      return error.field() + ": " + error.what();
    }
  };
  EXPECT_EQ(problem(instance("t7")),
            "tasks/1: MAPFW's JSON has no ids of tasks: read back, task 't7' (number 1) would be "
            "'t1' (number 1); expected that");
  EXPECT_EQ(problem(testing::instance_of({".."}, {{{0, 0}, std::nullopt, {{1, 0}}}})),
            "agents/0: agent 'a0' has no goal; expected one for every agent, because MAPFW's JSON "
            "requires it");
  InstanceBuilder chooser(testing::grid_of({"..."}));
  chooser.add_agent({.id = "a0", .start = {.place = 0}, .goal = std::nullopt, .goals = {1, 2}});
  EXPECT_EQ(problem(std::move(chooser).build()),
            "agents/0/goals: agent 'a0' has a choice of goals, which cannot be represented in "
            "MAPFW's JSON; expected 'goal'");
  EXPECT_EQ(problem(with_a_need()),
            "tasks/0/need: task 'lift' has a choice of agents, which cannot be represented in "
            "MAPFW's JSON; expected no 'need' below the number of its agents");
  EXPECT_TRUE(directory_.files().empty());
}

TEST(FormatSupport, TasksOutOfOrderNeedOtherDefaultIds) {
  InstanceBuilder builder(testing::grid_of({"......"}));
  builder.add_agent("a0", {0, 0}, Position{5, 0});
  builder.add_agent("a1", {1, 0}, Position{4, 0});
  builder.add_task("t0", {2, 0}, std::vector<std::string>{"a1"});
  builder.add_task("t1", {3, 0}, std::vector<std::string>{"a1", "a0"});
  const Instance swapped = std::move(builder).build();
  EXPECT_THROW(require_default_task_ids(swapped, "x"), NotRepresentable);
  const Instance renamed = with_default_task_ids(swapped);
  require_default_task_ids(renamed, "x");
  EXPECT_EQ(renamed.task(0).cell, 3);
  EXPECT_EQ(renamed.task(0).agents, (std::vector<AgentIndex>{1, 0}));
  EXPECT_EQ(renamed.task(1).cell, 2);
  EXPECT_EQ(renamed.task(1).agents, (std::vector<AgentIndex>{1}));
}

TEST(FormatSupport, RenamedInstancesKeepNeeds) {
  const Instance instance = with_a_need();
  const Instance agents = with_default_agent_ids(instance);
  EXPECT_EQ(agents.task(0).id, "lift");
  EXPECT_EQ(agents.task(0).need, 1);
  EXPECT_EQ(agents.task(0).agents, (std::vector<AgentIndex>{0, 1}));
  const Instance tasks = with_default_task_ids(instance);
  EXPECT_EQ(tasks.task(0).id, "lift");
  EXPECT_EQ(tasks.task(0).need, 1);
  EXPECT_THROW(require_default_task_ids(instance, "x"), NotRepresentable);
}

TEST(FormatSupport, WithoutTasksAgentsKeepTheirChoices) {
  InstanceBuilder builder(testing::grid_of({"..."}));
  builder.add_agent({.id = "a", .start = {.place = 0}, .goal = std::nullopt, .goals = {1, 2}});
  builder.add_task("t", {1, 0}, std::vector<std::string>{"a"});
  EXPECT_EQ(without_tasks(std::move(builder).build()).agent(0).goals, (std::vector<Place>{1, 2}));
}

TEST(FormatSupport, ReducedInstancesKeepAllElse) {
  InstanceBuilder builder(testing::grid_of({"...."}));
  builder.add_agent("red", {0, 0}, Position{3, 0});
  builder.add_task("shelf", {2, 0}, std::vector<std::string>{"red"});
  const Instance instance = std::move(builder).build();
  const Instance plain = without_tasks(instance);
  EXPECT_EQ(plain.task_count(), 0);
  EXPECT_EQ(plain.agent(0).id, "red");
  EXPECT_EQ(plain.agent(0).goal, instance.agent(0).goal);
  const Instance renamed = with_default_agent_ids(instance);
  EXPECT_EQ(renamed.agent(0).id, "a0");
  EXPECT_EQ(renamed.task(0).id, "shelf");
  EXPECT_EQ(renamed.task(0).agents, (std::vector<AgentIndex>{0}));
  InstanceBuilder mg(testing::grid_of({"...."}));
  mg.add_agent("m", {0, 0}, std::nullopt);
  mg.add_task("t", {2, 0}, std::vector<std::string>{"m"});
  EXPECT_THROW(without_tasks(std::move(mg).build()), InstanceError);
}

}  // namespace mapfw_file_test
}  // namespace grove::detail
