// SPDX-License-Identifier: MIT
#include "io/libmrp_file.h"

#include <gtest/gtest.h>

#include "io/format_support.h"
#include "tests/support/instances.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace libmrp_file_test {

// . @ . . .   Wider than high, and without symmetries.
// . . . . .
// . . . @ @
const std::string kMapText =
    "map:\n  dimensions: [5, 3]\n  obstacles:\n    - [1, 0]\n    - [3, 2]\n    - [4, 2]\n";
const std::string kMapf = kMapText +
                          "agents:\n  - name: agent0\n    start: [0, 0]\n    goal: [4, 0]\n"
                          "  - name: \"on\"\n    start: [3, 0]\n    goal: [1, 2]\n";
const std::string kMgMapf =
    kMapText +
    "agents:\n  - name: agent0\n    start: [4, 1]\n    goals:\n      - [0, 2]\n      - [2, 0]\n"
    "  - name: agent1\n    start: [0, 0]\n    goals:\n      - [2, 0]\n      - [3, 1]\n";

Grid grid() {
  return testing::grid_of({".@...", ".....", "...@@"});
}

Instance mapf() {
  InstanceBuilder builder(grid());
  builder.add_agent("agent0", {0, 0}, Position{4, 0});
  builder.add_agent("on", {3, 0}, Position{1, 2});
  return std::move(builder).build();
}

Instance mg_mapf(const std::string& last_task = "t2") {
  InstanceBuilder builder(grid());
  builder.add_agent("agent0", {4, 1}, std::nullopt);
  builder.add_agent("agent1", {0, 0}, std::nullopt);
  builder.add_task("t0", {0, 2}, std::vector<std::string>{"agent0"});
  builder.add_task("t1", {2, 0}, std::vector<std::string>{"agent0", "agent1"});
  builder.add_task(last_task, {3, 1}, std::vector<std::string>{"agent1"});
  return std::move(builder).build();
}

// Agents with a choice of destinations, with one, and without.
const std::string kTargets =
    kMapText +
    "agents:\n  - name: a0\n    start: [0, 0]\n    potentialGoals:\n      - [4, 0]\n"
    "      - [0, 0]\n      - [2, 2]\n  - name: a1\n    start: [3, 0]\n    potentialGoals:\n"
    "      - [2, 2]\n  - name: a2\n    start: [2, 1]\n    potentialGoals: []\n";

Instance targets() {
  const Grid map = grid();
  InstanceBuilder builder(map);
  builder.add_agent({.id = "a0",
                     .start = {.place = map.cell({0, 0})},
                     .goal = std::nullopt,
                     .goals = {map.cell({4, 0}), map.cell({0, 0}), map.cell({2, 2})}});
  builder.add_agent("a1", {3, 0}, Position{2, 2});
  builder.add_agent("a2", {2, 1}, std::nullopt);
  return std::move(builder).build();
}

// Returns agents, tasks and obstacles in one line, to compare instances.
std::string summary(const Instance& instance) {
  const Grid& grid = instance.grid();
  const auto cell = [&](Cell c) {
    const Position p = grid.position(c);
    return "(" + std::to_string(p.x) + "," + std::to_string(p.y) + ")";
  };
  std::string text = std::to_string(grid.width()) + "x" + std::to_string(grid.height());
  for (Cell c = 0; c < grid.cell_count(); ++c)
    if (!grid.passable(c)) text += " @" + cell(c);
  for (const Agent& agent : instance.agents()) {
    text += " " + agent.id + cell(agent.start) + (agent.goal ? cell(*agent.goal) : "");
    for (const Place goal : agent.goals) text += "|" + cell(goal);
  }
  for (const Task& task : instance.tasks()) {
    text += " " + task.id + cell(task.cell);
    for (AgentIndex agent : task.agents) text += instance.agent(agent).id;
  }
  return text;
}

class LibmrpFile : public ::testing::Test {
 protected:
  Instance read(const std::string& content) {
    return read_libmrp_instance(directory_.write("i.yaml", content), &warnings_);
  }
  std::string refused(const std::string& content) {
    return refusal([&] { read(content); });
  }
  std::string refused_with(const std::string& from, const std::string& to) {
    std::string text = kMapf;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return refused(text.replace(text.find(from), from.size(), to));
  }

  TemporaryDirectory directory_;
  std::vector<std::string> warnings_;
};

TEST_F(LibmrpFile, IsWrittenForItsTools) {
  write_libmrp_instance(directory_ / "o.yaml", mapf());
  EXPECT_EQ(file_content(directory_ / "o.yaml"), kMapf);
  write_mgcbs_instance(directory_ / "o.yaml", mg_mapf());
  EXPECT_EQ(file_content(directory_ / "o.yaml"), kMgMapf);
}

TEST_F(LibmrpFile, IsWrittenForSolversThatAssignGoals) {
  write_potential_goals(directory_ / "o.yaml", mapf());
  const std::string text = file_content(directory_ / "o.yaml");
  EXPECT_NE(text.find("    start: [0, 0]\n    potentialGoals:\n      - [4, 0]\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(summary(read(text)), summary(mapf()));
}

TEST_F(LibmrpFile, KeepsChoicesOfDestinations) {
  write_potential_goals(directory_ / "o.yaml", targets());
  EXPECT_EQ(file_content(directory_ / "o.yaml"), kTargets);
  EXPECT_EQ(summary(read(kTargets)), summary(targets()));
  EXPECT_EQ(summary(read(kTargets)),
            "5x3 @(1,0) @(3,2) @(4,2) a0(0,0)|(4,0)|(0,0)|(2,2) a1(3,0)(2,2) a2(2,1)");
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(LibmrpFile, CountsARepeatedPotentialGoalOnce) {
  const std::string start =
      "map: {dimensions: [3, 1], obstacles: []}\nagents:\n"
      "  - {name: a, start: [0, 0], potentialGoals: ";
  EXPECT_EQ(summary(read(start + "[[2, 0], [1, 0], [2, 0]]}\n")), "3x1 a(0,0)|(2,0)|(1,0)");
  EXPECT_EQ(summary(read(start + "[[2, 0], [2, 0]]}\n")), "3x1 a(0,0)(2,0)");
}

TEST_F(LibmrpFile, ReadsANamedMapWithCellsByRows) {
  directory_.write("m.map", "type octile\nheight 3\nwidth 5\nmap\n.@...\n.....\n...@@\n");
  const std::string by_rows =
      "agents:\n- name: a0\n  potentialGoals:\n  - [0, 4]\n  - [0, 0]\n  - [2, 2]\n"
      "  start: [0, 0]\n- {name: a1, start: [0, 3], goal: [2, 2]}\n"
      "- {name: a2, start: [1, 2], potentialGoals: []}\nmap: m.map\n";
  EXPECT_EQ(summary(read(by_rows)), summary(targets()));
  const auto refused_by_rows = [&](const std::string& from, const std::string& to) {
    std::string text = by_rows;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return refused(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(refused_by_rows("[0, 4]", "[4, 0]"),
            "i.yaml: line 4, column 5: cell [4, 0] is outside the map; expected [row, column] with "
            "row in 0..2 and column in 0..4");
  EXPECT_EQ(refused_by_rows("[0, 4]", "[2, 4]"),
            "i.yaml: line 4, column 5: cell [2, 4] is blocked on the map; expected a passable "
            "cell");
  EXPECT_NE(refused_by_rows("map: m.map", "map: none.map").find("i.yaml: line 10, column 6: "),
            std::string::npos);
  EXPECT_EQ(refused_by_rows("map: m.map", "map: ''"),
            "i.yaml: line 10, column 6: found ''; expected a map, or the name of a map file");
  EXPECT_EQ(refused_by_rows("map: m.map", "map: [3, 2]"),
            "i.yaml: line 10, column 6: found a list; expected a map");
  std::filesystem::create_directory(directory_ / "below");
  const std::string below =
      directory_.write("below/i.yaml", by_rows.substr(0, by_rows.size() - 6) + "../m.map\n");
  EXPECT_EQ(read_libmrp_instance(below).agent_count(), 3);
  EXPECT_TRUE(refusal([&] {
                read_libmrp_instance(below, nullptr, {.confined = true});
              }).starts_with("i.yaml: line 10, column 6: '../m.map'"));
}

TEST_F(LibmrpFile, IsReadBack) {
  EXPECT_EQ(summary(read(kMapf)), summary(mapf()));
  EXPECT_EQ(summary(read(kMapf)), "5x3 @(1,0) @(3,2) @(4,2) agent0(0,0)(4,0) on(3,0)(1,2)");
  EXPECT_EQ(summary(read(kMgMapf)), summary(mg_mapf()));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(LibmrpFile, ReadsEquivalentYaml) {
  EXPECT_EQ(summary(read("{map: {dimensions: [5, 3], obstacles: [!!python/tuple [4, 2], [3, 2], "
                         "[1, 0], [1, 0]]},\nagents: [{name: agent0, start: [0, 0], goal: [4, 0]}, "
                         "{start: [3, 0], potentialGoals: [[1, 2]], name: 'on'}]}")),
            summary(mapf()));
  EXPECT_EQ(
      summary(read("map:\r\n  dimensions: [2, 1]\r\n  obstacles:\r\nagents:\r\n  - name: 7\r\n"
                   "    start: [1, 0]\r\n    goal: [0, 0]\r\n")),
      "2x1 7(1,0)(0,0)");
}

TEST_F(LibmrpFile, AcceptsDirectivesAndDocumentMarkers) {
  EXPECT_EQ(summary(read("%YAML 1.2\n---\n" + kMapf + "...\n# the end\n")), summary(mapf()));
  EXPECT_EQ(summary(read("\xEF\xBB\xBF# the beginning\n" + kMapf)), summary(mapf()));
  EXPECT_EQ(refused("# nothing\n"), "i.yaml: is empty; expected a YAML map");
}

TEST_F(LibmrpFile, KeepsNamesThatYamlMustQuote) {
  for (const std::string name :
       {"null", "~",   "7", "a b",    "a: b", "#",   "'", "\"", "-",  "\n", "\t",   "\x01",
        "\x7f", "\\n", "é", "\u2028", "Yes",  "1e3", "[", " ",  "*a", "!t", "0x10", "a\r\nb"}) {
    InstanceBuilder builder(grid());
    builder.add_agent(name, {0, 0}, Position{4, 0});
    write_libmrp_instance(directory_ / "o.yaml", std::move(builder).build());
    EXPECT_EQ(read_libmrp_instance(directory_ / "o.yaml").agent(0).id, name)
        << file_content(directory_ / "o.yaml");
  }
}

// Python's yaml takes some non-ASCII characters for line ends.
TEST_F(LibmrpFile, WritesAsciiOnly) {
  InstanceBuilder builder(grid());
  builder.add_agent("\u2028\u0085\u00e9", {0, 0}, Position{4, 0});
  write_libmrp_instance(directory_ / "o.yaml", std::move(builder).build());
  EXPECT_NE(file_content(directory_ / "o.yaml").find("name: \"\\u2028\\x85\\xe9\"\n"),
            std::string::npos)
      << file_content(directory_ / "o.yaml");
}

TEST_F(LibmrpFile, WritesAnEmptyListOfObstacles) {
  InstanceBuilder builder(testing::grid_of({"..", ".."}));
  builder.add_agent("a", {0, 0}, Position{1, 0});
  write_libmrp_instance(directory_ / "o.yaml", std::move(builder).build());
  EXPECT_EQ(file_content(directory_ / "o.yaml"),
            "map:\n  dimensions: [2, 2]\n  obstacles: []\nagents:\n  - name: a\n    start: [0, 0]\n"
            "    goal: [1, 0]\n");
  EXPECT_EQ(summary(read_libmrp_instance(directory_ / "o.yaml")), "2x2 a(0,0)(1,0)");
}

TEST_F(LibmrpFile, WarnsAboutUnknownKeys) {
  read(kMapf + "note: 1\n");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("i.yaml: line 14, column 1: unknown key 'note' is ignored"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(LibmrpFile, RefusesInvalidFilesWithThePlace) {
  EXPECT_EQ(refused(""), "i.yaml: is empty; expected a YAML map");
  EXPECT_EQ(refused("hello"),
            "i.yaml: line 1, column 1: found 'hello'; expected a map with the keys 'map' and "
            "'agents'");
  EXPECT_EQ(refused(kMapf + "---\na: 1\n"),
            "i.yaml: has more than one YAML document; expected one");
  EXPECT_EQ(refused("," + kMapf), "i.yaml: has more than one YAML document; expected one");
  EXPECT_EQ(refused_with("[4, 0]", "[4, 0"),
            "i.yaml: line 11, column 9: malformed YAML: end of sequence flow not found; expected a "
            "YAML map");
  EXPECT_EQ(refused_with("dimensions", "dims"),
            "i.yaml: line 2, column 3: key 'dimensions' is missing; expected it in this map");
  EXPECT_EQ(refused_with("obstacles", "obstacle"),
            "i.yaml: line 2, column 3: key 'obstacles' is missing; expected it in this map");
  EXPECT_EQ(refused_with("agents", "agent"),
            "i.yaml: line 1, column 1: key 'agents' is missing; expected it in this map");
  EXPECT_EQ(refused_with("[0, 0]", "[0]"),
            "i.yaml: line 9, column 12: found a list; expected a cell [x, y]");
  EXPECT_EQ(refused_with("[0, 0]", "A"),
            "i.yaml: line 9, column 12: found 'A'; expected a cell [x, y]");
  EXPECT_EQ(refused_with("[3, 2]", "[3, 3]"),
            "i.yaml: line 5, column 7: obstacle [3, 3] is outside the map; expected x in 0..4 and "
            "y in 0..2");
  EXPECT_EQ(refused_with("[4, 0]", "[0, 4]"),
            "i.yaml: line 10, column 11: cell [0, 4] is outside the map; expected [x, y] (column, "
            "row) with x in 0..4 and y in 0..2");
  EXPECT_EQ(refused_with("[3, 0]", "[1, 0]"),
            "i.yaml: line 12, column 12: cell [1, 0] is blocked on the map; expected a passable "
            "cell");
  EXPECT_EQ(refused_with("[3, 0]", "[0, 0]"),
            "i.yaml: line 12, column 12: cell [0, 0] is already the start of agent 'agent0'; "
            "expected distinct starts");
  EXPECT_EQ(refused_with("\"on\"", "agent0"),
            "i.yaml: line 11, column 11: id 'agent0' is used twice; expected distinct ids");
  EXPECT_EQ(refused_with("\"on\"", "~"),
            "i.yaml: line 11, column 11: found nothing; expected a text");
  EXPECT_EQ(refused_with("\"on\"", "\xff"),
            "i.yaml: line 11, column 11: found '\\xff'; expected a text in UTF-8 without NUL "
            "characters");
  EXPECT_EQ(refused_with("    goal: [4, 0]\n", ""),
            "i.yaml: line 8, column 5: expected exactly one of the keys 'goal', 'goals' and "
            "'potentialGoals'");
  EXPECT_EQ(refused_with("goal: [4, 0]", "goal: [4, 0]\n    potentialGoals: [[3, 0]]"),
            "i.yaml: line 8, column 5: expected exactly one of the keys 'goal', 'goals' and "
            "'potentialGoals'");
  EXPECT_EQ(refused_with("goal: [4, 0]", "potentialGoals: [[4, 0], [3, 9]]"),
            "i.yaml: line 10, column 30: cell [3, 9] is outside the map; expected [x, y] (column, "
            "row) with x in 0..4 and y in 0..2");
  EXPECT_EQ(refused_with("goal: [4, 0]", "potentialGoals: [[4, 0], [1, 0]]"),
            "i.yaml: line 10, column 30: cell [1, 0] is blocked on the map; expected a passable "
            "cell");
  EXPECT_EQ(refused_with("goal: [4, 0]", "potentialGoals: [4, 0]"),
            "i.yaml: line 10, column 22: found '4'; expected a cell [x, y]");
  EXPECT_EQ(refused_with("goal: [4, 0]", "potentialGoals: x"),
            "i.yaml: line 10, column 21: found 'x'; expected a list");
  EXPECT_EQ(refused_with("goal: [1, 2]", "potentialGoals: [[4, 0]]"),
            "i.yaml: line 13, column 22: cell [4, 0] is already the goal of agent 'agent0'; "
            "expected distinct goals");
  EXPECT_EQ(refused_with("goal: [4, 0]", "goal: [4, 0]\n    goal: [3, 1]"),
            "i.yaml: line 11, column 5: key 'goal' appears twice; expected distinct keys");
  EXPECT_EQ(refused_with("goal: [4, 0]", "goals: [[4, 0], [3, 1], [4, 0]]"),
            "i.yaml: line 10, column 29: agent 'agent0' lists cell [4, 0] twice; expected distinct "
            "cells");
  EXPECT_EQ(refused_with("goal: [4, 0]", "goals: [[4, 0], [1, 0]]"),
            "i.yaml: line 10, column 21: cell [1, 0] is blocked on the map; expected a passable "
            "cell");
  EXPECT_EQ(refused_with("goal: [4, 0]", "goals: []"),
            "i.yaml: line 10, column 12: there are no goals; expected at least one");
  EXPECT_EQ(refused(kMapText + "agents: []\n"),
            "i.yaml: line 7, column 9: expected at least one agent");
  EXPECT_EQ(refused("roadmap:\n  undirected: true\nagents: []\n"),
            "i.yaml: line 2, column 3: found a roadmap; expected a grid, given by the key 'map'");
}

TEST_F(LibmrpFile, TakesOnlyDecimalIntegers) {
  for (const char* wrong : {"-1", "1.0", "01", "010", "0x1", "1e0", "x", "2147483648",
                            "99999999999999999999999", "''", "~", "[0]", "{}", "+1", "1_0", "0o1"})
    EXPECT_EQ(refused_with("[4, 0]", "[4, " + std::string(wrong) + "]").substr(0, 34),
              "i.yaml: line 10, column 15: found ")
        << wrong;
  EXPECT_EQ(refused_with("[5, 3]", "[5, 0]"),
            "i.yaml: line 2, column 19: found '0'; expected a decimal integer from 1 to 16777216");
  EXPECT_EQ(refused_with("[5, 3]", "[16777216, 2]"),
            "i.yaml: line 2, column 15: found 16777216 x 2 cells; expected at most 16777216");
}

TEST_F(LibmrpFile, SurvivesDeepNesting) {
  for (const std::string opening : {"[", "{a: ", "- ", "? "}) {
    std::string text;
    for (int k = 0; k < 20'000; ++k) text += opening;
    EXPECT_EQ(refused(text).substr(0, 8), "i.yaml: ") << opening;
    EXPECT_EQ(refused("map: " + text).substr(0, 8), "i.yaml: ") << opening;
  }
}

TEST_F(LibmrpFile, RefusesMoreThan64GoalsWithThePlace) {
  std::string goals;
  for (int x = 1; x <= 65; ++x) goals += "      - [" + std::to_string(x) + ", 0]\n";
  EXPECT_EQ(
      refused("map:\n  dimensions: [70, 1]\n  obstacles: []\nagents:\n  - name: a\n"
              "    start: [0, 0]\n    goals:\n" +
              goals),
      "i.yaml: line 72, column 9: agent 'a' must visit more than 64 tasks; expected at most 64");
}

TEST_F(LibmrpFile, UnrepresentableInstancesAreNotWritten) {
  const auto problem = [&](auto write, const Instance& instance) -> std::string {
    try {
      write(directory_ / "o.yaml", instance);
    } catch (const NotRepresentable& error) {
      return error.field() + ": " + error.what();
    }
    return "written";
  };
  EXPECT_EQ(problem(write_libmrp_instance, mg_mapf()),
            "agents/0: agent 'agent0' has no goal; expected one for every agent, because "
            "libMultiRobotPlanning's YAML requires it");
  EXPECT_EQ(problem(write_libmrp_instance,
                    testing::instance_of({"..."}, {{{0, 0}, Position{2, 0}, {{1, 0}}}})),
            "tasks/0: task 't0' cannot be represented in libMultiRobotPlanning's YAML; expected no "
            "tasks");
  EXPECT_EQ(
      problem(write_mgcbs_instance, mapf()),
      "agents/0: agent 'agent0' has a goal to end on, which cannot be represented in MGCBS's YAML; "
      "expected an agent that may end on any of its tasks (MG-MAPF)");
  EXPECT_EQ(problem(write_mgcbs_instance, mg_mapf("shelf")),
            "tasks/2: MGCBS's YAML has no ids of tasks: read back, task 'shelf' (number 2) would "
            "be 't2' (number 2); expected that");
  EXPECT_EQ(problem(write_libmrp_instance, targets()),
            "agents/0/goals: agent 'a0' has a choice of goals, which cannot be represented in "
            "libMultiRobotPlanning's YAML for CBS; expected the format potential-goals (CBS-TA), "
            "or 'goal'");
  EXPECT_EQ(problem(write_potential_goals, mg_mapf()),
            "tasks/0: task 't0' cannot be represented in libMultiRobotPlanning's YAML; expected no "
            "tasks");
  EXPECT_EQ(
      problem(write_mgcbs_instance, targets()),
      "agents/0/goals: agent 'a0' has a choice of goals, which cannot be represented in MGCBS's "
      "YAML; expected 'goal'");
  InstanceBuilder builder(grid());
  builder.add_agent("a", {0, 0}, std::nullopt);
  builder.add_agent("b", {4, 0}, std::nullopt);
  const std::vector<std::string> both = {"a", "b"};
  builder.add_task("t0", {2, 1}, both);
  builder.add_task("t1", {0, 2}, both, 0, 1);
  EXPECT_EQ(problem(write_mgcbs_instance, std::move(builder).build()),
            "tasks/1/need: task 't1' has a choice of agents, which cannot be represented in "
            "MGCBS's YAML; expected no 'need' below the number of its agents");
  EXPECT_TRUE(directory_.files().empty());
}

}  // namespace libmrp_file_test
}  // namespace grove::detail
