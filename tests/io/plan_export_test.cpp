// SPDX-License-Identifier: MIT
// Compares plans in the formats of other tools byte by byte.
#include "io/plan_export.h"

#include <gtest/gtest.h>

#include "io/format_support.h"
#include "io/tracker_file.h"
#include "model/check.h"
#include "tests/support/instances.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace plan_export_test {

// . @ . . .   Wider than high, and without symmetries.
// . . . . .
// . . . @ @
class PlanExport : public ::testing::Test {
 protected:
  // The paths are valid with and without tasks.
  static Instance make_instance(bool tasks) {
    InstanceBuilder builder(testing::grid_of({".@...", ".....", "...@@"}));
    builder.add_agent("red", {0, 0}, Position{4, 0});
    builder.add_agent("no", {3, 0}, tasks ? std::nullopt : std::optional(Position{1, 2}));
    builder.add_agent("third one", {0, 2}, Position{0, 2});
    if (tasks) builder.add_task("shelf", {1, 2}, std::vector<std::string>{"no"});
    return std::move(builder).build();
  }

  // The first agent moves in every step, the second waits on its path and at the end, and the third
  // rests from the start.
  Solution make_solution(const Instance& instance) {
    const auto path = [&](const std::vector<Position>& positions) {
      Path cells;
      for (Position p : positions) cells.push_back(instance.grid().cell(p));
      return cells;
    };
    Solution solution;
    solution.plan = Plan{
        12,
        {{6, {}, path({{0, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {4, 0}})},
         {6, {}, path({{3, 0}, {2, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {1, 2}, {1, 2}})},
         {0, {}, path({{0, 2}})}}};
    if (instance.task_count() > 0) solution.plan->agents[1].sequence = {0};
    solution.status = Status::kBounded;
    solution.lower_bound = 10;
    solution.omega = Omega::parse("0.2");
    solution.stats.measures["wall_s"] = 0.25;
    solution.stats.counts["nodes_expanded"] = 7;
    solution.stats.counts["seed"] = 3;
    return solution;
  }

  template <typename Write>
  std::string written(Write write) {
    EXPECT_TRUE(check(instance_, solution_).empty());
    write(directory_ / "out");
    return file_content(directory_ / "out");
  }
  std::string tracker_row(TrackerLayout layout, TrackerUp up) {
    const Instance instance = make_instance(false);
    const Solution solution = make_solution(instance);
    EXPECT_TRUE(check(instance, solution).empty());
    return written([&](const std::string& path) {
      write_tracker_row(path, instance, solution, {"random-32-32-20", "even", 1}, layout, up);
    });
  }

  const Instance instance_ = make_instance(true);
  Solution solution_ = make_solution(instance_);
  TemporaryDirectory directory_;
};

std::string steps(const std::vector<Position>& positions) {
  std::string text;
  for (std::size_t t = 0; t < positions.size(); ++t)
    text += "    - x: " + std::to_string(positions[t].x) +
            "\n      y: " + std::to_string(positions[t].y) + "\n      t: " + std::to_string(t) +
            "\n";
  return text;
}

TEST_F(PlanExport, LibmrpScheduleEndsWithEachAgent) {
  EXPECT_EQ(
      written([&](const std::string& path) { write_libmrp_schedule(path, instance_, solution_); }),
      "statistics:\n  cost: 12\n  makespan: 6\n  runtime: 0.25\n  highLevelExpanded: 7\n"
      "schedule:\n  red:\n" +
          steps({{0, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {4, 0}}) + "  \"no\":\n" +
          steps({{3, 0}, {2, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}}) +
          "  \"third one\":\n    - x: 0\n      y: 2\n      t: 0\n");
}

TEST_F(PlanExport, LibmrpSchedulesHaveNoKeysTooLongForYaml) {
  const auto write = [&](std::size_t size) {
    InstanceBuilder builder(testing::grid_of({"."}));
    builder.add_agent(std::string(size, 'x'), {0, 0}, Position{0, 0});
    Solution solution;
    solution.plan = Plan{0, {{0, {}, {0}}}};
    write_libmrp_schedule(directory_ / "out", std::move(builder).build(), solution);
  };
  write(1024);
  EXPECT_THROW(write(1025), NotRepresentable);
}

TEST_F(PlanExport, VisualizerTextIsPaddedWithTrailingCommas) {
  EXPECT_EQ(written([&](const std::string& path) {
              write_visualizer_text(path, instance_, solution_, "m.map");
            }),
            "agents=3\nmap_file=m.map\nsolver=grove\nsolved=1\nsoc=12\nsoc_lb=10\nmakespan=6\n"
            "makespan_lb=6\nsum_of_loss=12\nsum_of_loss_lb=10\ncomp_time=250\nseed=3\n"
            "starts=(0,0),(3,0),(0,2),\n"
            "goals=(4,0),(1,2),(0,2),\n"
            "solution=\n"
            "0:(0,0),(3,0),(0,2),\n"
            "1:(0,1),(2,0),(0,2),\n"
            "2:(1,1),(2,0),(0,2),\n"
            "3:(2,1),(2,0),(0,2),\n"
            "4:(3,1),(2,1),(0,2),\n"
            "5:(4,1),(2,2),(0,2),\n"
            "6:(4,0),(1,2),(0,2),\n");
}

TEST_F(PlanExport, OmitsStatsThatThePlanFileLacks) {
  solution_.stats = {};
  EXPECT_EQ(written([&](const std::string& path) {
              write_libmrp_schedule(path, instance_, solution_);
            }).substr(0, 50),
            "statistics:\n  cost: 12\n  makespan: 6\nschedule:\n  r");
  EXPECT_NE(written([&](const std::string& path) {
              write_visualizer_text(path, instance_, solution_, "m.map");
            }).find("sum_of_loss_lb=10\nstarts="),
            std::string::npos);
}

TEST_F(PlanExport, LossCountsLeavingTheGoalButNoRestOnIt) {
  // The agent is on its goal from 1 to 2 and from 4 on. The step on its goal is no loss; the other
  // three steps are.
  const Instance instance = testing::instance_of({"..."}, {{{0, 0}, Position{1, 0}}});
  Solution solution;
  solution.plan = Plan{4, {{4, {}, {0, 1, 1, 2, 1}}}};
  write_visualizer_text(directory_ / "out", instance, solution, "m.map");
  EXPECT_NE(file_content(directory_ / "out").find("soc=4\n"), std::string::npos);
  EXPECT_NE(file_content(directory_ / "out").find("sum_of_loss=3\n"), std::string::npos);
}

TEST_F(PlanExport, PathListsAreRowsAndColumnsWithoutPadding) {
  EXPECT_EQ(written([&](const std::string& path) { write_path_lists(path, instance_, solution_); }),
            "Agent 0: (0,0)->(1,0)->(1,1)->(1,2)->(1,3)->(1,4)->(0,4)->\n"
            "Agent 1: (0,3)->(0,2)->(0,2)->(0,2)->(1,2)->(2,2)->(2,1)->\n"
            "Agent 2: (2,0)->\n");
}

TEST_F(PlanExport, TrackerRowsChargeNoRest) {
  EXPECT_EQ(tracker_row(TrackerLayout::kJson, TrackerUp::kTowardsRowZero),
            R"([{"map_name":"random-32-32-20","scen_type":"even","type_id":1,"agents":3,)"
            R"("lower_cost":10,"solution_cost":12,"flip_up_down":false,)"
            R"("solution_plan":"d4ru\nl2w2dl\n"}])"
            "\n");
  EXPECT_EQ(
      tracker_row(TrackerLayout::kCsv, TrackerUp::kTowardsRowZero),
      "map_name,scen_type,type_id,agents,lower_cost,solution_cost,flip_up_down,solution_plan\n"
      "\"random-32-32-20\",\"even\",1,3,10,12,FALSE,\"d4ru\nl2w2dl\n\"\n");
}

TEST_F(PlanExport, TrackerRowsCanBeFlipped) {
  EXPECT_EQ(tracker_row(TrackerLayout::kJson, TrackerUp::kAwayFromRowZero),
            R"([{"map_name":"random-32-32-20","scen_type":"even","type_id":1,"agents":3,)"
            R"("lower_cost":10,"solution_cost":12,"flip_up_down":true,)"
            R"("solution_plan":"u4rd\nl2w2ul\n"}])"
            "\n");
}

TEST_F(PlanExport, TrackerRowsRefuseTasks) {
  const auto write = [&](const Instance& instance) {
    write_tracker_row(directory_ / "out", instance, solution_, {"m", "even", 1},
                      TrackerLayout::kJson, TrackerUp::kTowardsRowZero);
  };
  EXPECT_THROW(write(instance_), NotRepresentable);
  EXPECT_THROW(write(testing::instance_of({"..."}, {{{0, 0}, Position{2, 0}, {{1, 0}}}})),
               NotRepresentable);
  EXPECT_TRUE(directory_.files().empty());
}

TEST_F(PlanExport, RefusesAMissingFolder) {
  EXPECT_EQ(refusal([&] { write_path_lists(directory_ / "none/o", instance_, solution_); }),
            "o: cannot be written: No such file or directory");
}

TEST(TrackerScenario, IsTypeAndNumber) {
  const auto scenario = parse_tracker_scenario("m", "random-25");
  ASSERT_TRUE(scenario);
  EXPECT_EQ(scenario->map, "m");
  EXPECT_EQ(scenario->type, "random");
  EXPECT_EQ(scenario->number, 25);
  for (const char* wrong : {"", "even", "even-", "even-x", "even--1", "even-1 ", "odd-1", "-1",
                            "even-99999999999", "random-32-32-20-even-1"})
    EXPECT_FALSE(parse_tracker_scenario("m", wrong)) << wrong;
}

// Each place has its time, each wait has a start and an end, and tasks are named where they are
// completed.
TEST_F(PlanExport, WaypointsHaveTimesPosesAndTasks) {
  const Scale scale{{0.5, {10, 20}}, 2};
  const std::string text =
      written([&](const auto& path) { write_waypoints(path, instance_, solution_, scale); });
  EXPECT_EQ(text.substr(0, text.find("no,")),
            "robot,seconds,x,y,theta,task\n"
            "red,0,10.25,21.25,-1.570796,\n"
            "red,2,10.25,20.75,0.000000,\n"
            "red,4,10.75,20.75,0.000000,\n"
            "red,6,11.25,20.75,0.000000,\n"
            "red,8,11.75,20.75,0.000000,\n"
            "red,10,12.25,20.75,1.570796,\n"
            "red,12,12.25,21.25,1.570796,\n");
  EXPECT_NE(text.find("no,2,11.25,21.25,-1.570796,\nno,6,11.25,21.25,-1.570796,\n"),
            std::string::npos);
  EXPECT_NE(text.find("no,12,10.75,20.25,3.141593,shelf\n"), std::string::npos);
  EXPECT_NE(text.find("third one,0,10.25,20.25,0.000000,\n"), std::string::npos);
}

TEST_F(PlanExport, NavPathsHaveStampsAndPoses) {
  const std::string text = written([&](const auto& path) {
    write_nav_paths(path, instance_, solution_, {{1, {}}, 0.5});
  });
  EXPECT_NE(text.find("\n\"third one\":\n  header: {stamp: {sec: 0, nanosec: 0}, frame_id: map}\n"),
            std::string::npos);
  EXPECT_NE(text.find("header: {stamp: {sec: 1, nanosec: 500000000}, frame_id: map}\n"
                      "      pose:\n"
                      "        position: {x: 2.5000, y: 1.5000, z: 0.0}\n"
                      "        orientation: {x: 0.0, y: 0.0, z: 0.000000000, w: 1.000000000}\n"),
            std::string::npos);
}

// In PlanViz, action U moves one row down.
TEST_F(PlanExport, PlanVizHasActionsAndEvents) {
  const std::string text =
      written([&](const auto& path) { write_planviz(path, instance_, solution_); });
  for (const char* part : {"\"actionModel\": \"MAPF\"", "[0,0,\"E\"]", "[2,0,\"E\"]",
                           "\"U,R,R,R,R,D\"", "\"L,W,W,U,U,L\"", "\"W,W,W,W,W,W\"",
                           "\"makespan\": 6", "[6,1,1,1]", "[1,0,[2,1]]", "[0,0,[0,4]]"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

// The agent ends on the farther one of the destinations from which it chooses.
TEST_F(PlanExport, NamesTheChosenDestination) {
  InstanceBuilder builder(testing::grid_of({"....."}));
  builder.add_agent({.id = "a", .start = {.place = 1}, .goal = std::nullopt, .goals = {0, 4}});
  const Instance instance = std::move(builder).build();
  Solution solution;
  solution.plan = Plan{3, {{3, {}, {1, 2, 3, 4}}}};
  solution.status = Status::kFeasible;
  solution.omega = Omega::infinite();
  ASSERT_TRUE(check(instance, solution).empty());
  write_planviz(directory_ / "out", instance, solution);
  EXPECT_NE(file_content(directory_ / "out").find("[0,0,[0,4]]"), std::string::npos)
      << file_content(directory_ / "out");
  write_visualizer_text(directory_ / "out", instance, solution, "m.map");
  const std::string text = file_content(directory_ / "out");
  EXPECT_NE(text.find("\nmakespan=3\nmakespan_lb=1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\ngoals=(4,0),\n"), std::string::npos) << text;
}

TEST_F(PlanExport, PlanVizRefusesTurnsOfSeveralSteps) {
  for (const Time steps : {1, 2}) {
    InstanceBuilder builder(testing::grid_of({".."}));
    builder.add_agent({.id = "a",
                       .start = {0, Heading::kNorth, Heading::kNorth, 0},
                       .goal = Place{1},
                       .motion = {steps}});
    const Instance instance = std::move(builder).build();
    const auto state = [&](Place place, Heading from, Heading to, Time k) {
      return instance.state_of(0, {place, from, to, k});
    };
    Path path{state(0, Heading::kNorth, Heading::kNorth, 0)};
    if (steps == 2) path.push_back(state(0, Heading::kNorth, Heading::kEast, 1));
    path.push_back(state(0, Heading::kEast, Heading::kEast, 0));
    path.push_back(state(1, Heading::kEast, Heading::kEast, 0));
    Solution solution;
    solution.plan =
        Plan{static_cast<Cost>(path.size()) - 1, {{static_cast<Time>(path.size()) - 1, {}, path}}};
    solution.status = Status::kFeasible;
    ASSERT_TRUE(check(instance, solution).empty());
    const auto write = [&] { write_planviz(directory_ / "out", instance, solution); };
    if (steps == 2) {
      EXPECT_THROW(write(), NotRepresentable);
    } else {
      write();
      const std::string text = file_content(directory_ / "out");
      EXPECT_NE(text.find("\"R,F\""), std::string::npos) << text;
      EXPECT_NE(text.find("[0,0,\"N\"]"), std::string::npos) << text;
    }
  }
}

}  // namespace plan_export_test
}  // namespace grove::detail
