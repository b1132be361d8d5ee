// SPDX-License-Identifier: MIT
// Tests that files in formats of other tools never lose a choice of an instance: the writers and
// readers refuse it or keep it.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "execution/action_dependency_graph.h"
#include "io/change_file.h"
#include "io/format_support.h"
#include "io/instance_file.h"
#include "io/libmrp_file.h"
#include "io/mapfw_file.h"
#include "io/plan_export.h"
#include "io/plan_import.h"
#include "io/tracker_file.h"
#include "model/check.h"
#include "model/choices.h"
#include "tests/support/choices.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace choices_exchange_test {

using testing::instance_with_goals;
using testing::instance_with_need;
using testing::solution_with_goals;
using testing::solution_with_need;

using File = std::filesystem::path;
using WriteInstance = std::function<void(const File&, const Instance&)>;
using WritePlan = std::function<void(const File&, const Instance&, const Solution&)>;

class ChoicesExchange : public ::testing::Test {
 protected:
  // Returns "field: message" of the refusal.
  std::string refused(const std::function<void(const File&)>& write) {
    const File file = directory_ / "out";
    try {
      write(file);
    } catch (const NotRepresentable& error) {
      EXPECT_FALSE(std::filesystem::exists(file));
      return error.field() + ": " + error.what();
    }
    return "written";
  }
  ClaimedPlan read(const std::string& text, const Instance& instance) {
    return read_plan_of_any_tool(directory_.write("plan", text), instance);
  }
  TemporaryDirectory directory_;
};

std::string need_in(const std::string& format) {
  return "tasks/0/need: task 't0' has a choice of agents, which cannot be represented in " +
         format + "; expected no 'need' below the number of its agents";
}

TEST_F(ChoicesExchange, PlansOfTheTestsAreValid) {
  EXPECT_TRUE(check(instance_with_goals(), solution_with_goals()).empty());
  EXPECT_TRUE(check(instance_with_need(), solution_with_need()).empty());
}

TEST_F(ChoicesExchange, InstanceFormatsRefuseNeeds) {
  const auto refused_by = [&](const WriteInstance& write) {
    return refused([&](const File& path) { write(path, instance_with_need()); });
  };
  const std::string no_tasks = "tasks/0: task 't0' cannot be represented in ";
  const std::string yaml = "libMultiRobotPlanning's YAML; expected no tasks";
  EXPECT_EQ(refused_by(&write_libmrp_instance), no_tasks + yaml);
  EXPECT_EQ(refused_by(&write_potential_goals), no_tasks + yaml);
  EXPECT_EQ(refused_by(&write_mgcbs_instance), need_in("MGCBS's YAML"));
  EXPECT_EQ(refused_by(&write_mapfw_problem), need_in("MAPFW's JSON"));
  EXPECT_EQ(refused_by([](const File& path, const Instance& instance) {
              write_scenario_instance(path, instance, "m.map");
            }),
            no_tasks + "a .scen file; expected no tasks");
}

TEST_F(ChoicesExchange, InstanceFormatsWithoutListsRefuseGoals) {
  const std::vector<WriteInstance> writers{&write_libmrp_instance, &write_mgcbs_instance,
                                           &write_mapfw_problem,
                                           [](const File& path, const Instance& instance) {
                                             write_scenario_instance(path, instance, "m.map");
                                           }};
  for (const WriteInstance& write : writers) {
    const std::string message =
        refused([&](const File& path) { write(path, instance_with_goals()); });
    EXPECT_TRUE(
        message.starts_with("agents/0/goals: agent 'a0' has a choice of goals, which cannot "
                            "be represented in "))
        << message;
  }
}

TEST_F(ChoicesExchange, PathFormatsRefuseNeeds) {
  const std::vector<std::pair<std::string, WritePlan>> writers{
      {"libMultiRobotPlanning's schedule", &write_libmrp_schedule},
      {"EECBS's path lists", &write_path_lists},
      {"mapf-visualizer's text",
       [](const File& path, const Instance& instance, const Solution& solution) {
         write_visualizer_text(path, instance, solution, "m.map");
       }}};
  for (const auto& [format, write] : writers)
    EXPECT_EQ(
        refused([&](const File& path) { write(path, instance_with_need(), solution_with_need()); }),
        need_in(format));
}

TEST_F(ChoicesExchange, TrackerRowsRefuseChoices) {
  const auto row = [&](const Instance& instance, const Solution& solution) {
    return refused([&](const File& path) {
      write_tracker_row(path, instance, solution, {"m", "even", 1}, TrackerLayout::kJson,
                        TrackerUp::kTowardsRowZero);
    });
  };
  EXPECT_EQ(
      row(instance_with_goals(), solution_with_goals()),
      "agents/0/goals: agent 'a0' has a choice of goals, which cannot be represented in a row "
      "of MAPF Tracker; expected 'goal'");
  EXPECT_NE(row(instance_with_need(), solution_with_need()), "written");
}

// A plan that can be written as paths is read back with the same choice of goals.
TEST_F(ChoicesExchange, PathFormatsContainTheChosenGoals) {
  const Instance instance = instance_with_goals();
  write_path_lists(directory_ / "paths", instance, solution_with_goals());
  const ClaimedPlan plan = read_plan_of_any_tool(directory_ / "paths", instance);
  EXPECT_EQ(plan.solution.plan->cost, 2);
  EXPECT_TRUE(check(instance, plan.solution).empty());
}

// The errands of an agent are its visits, stated or not.
TEST_F(ChoicesExchange, PlanVizContainsStatedVisits) {
  write_planviz(directory_ / "out", instance_with_need(), solution_with_need());
  const std::string text = file_content(directory_ / "out");
  EXPECT_NE(text.find("[1,0,[0,2,0,4]]"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  [1,1,1,1],\n  [3,1,1,2]]"), std::string::npos) << text;
}

// Waypoints name the task of each visit, stated or not.
TEST_F(ChoicesExchange, WaypointsContainStatedVisits) {
  write_waypoints(directory_ / "out.csv", instance_with_need(), solution_with_need(), {{1, {}}, 1});
  EXPECT_EQ(file_content(directory_ / "out.csv"),
            "robot,seconds,x,y,theta,task\n"
            "a0,0,1.5,0.5,3.141593,\n"
            "a0,1,0.5,0.5,3.141593,\n"
            "a1,0,3.5,0.5,3.141593,\n"
            "a1,1,2.5,0.5,0.000000,t0\n"
            "a1,2,3.5,0.5,0.000000,\n"
            "a1,3,4.5,0.5,0.000000,\n");
}

TEST_F(ChoicesExchange, CopiesWithOtherIdsKeepChoices) {
  for (const Instance& copy : {with_default_task_ids(instance_with_need()),
                               with_default_agent_ids(instance_with_need())}) {
    ASSERT_EQ(copy.task_count(), 1);
    EXPECT_EQ(copy.task(0).need, 1);
    EXPECT_EQ(copy.agent(0).options, (std::vector<TaskIndex>{0}));
  }
  EXPECT_EQ(with_default_agent_ids(instance_with_goals()).agent(0).goals,
            instance_with_goals().agent(0).goals);
  EXPECT_EQ(without_tasks(instance_with_goals()).agent(0).goals,
            instance_with_goals().agent(0).goals);
}

TEST_F(ChoicesExchange, PlansOfOtherToolsTellNoVisits) {
  const std::string paths = "Agent 0: (0,1)->(0,0)->\nAgent 1: (0,3)->(0,2)->(0,3)->(0,4)->\n";
  EXPECT_EQ(refusal([&] { read(paths, instance_with_need()); }),
            "plan: line 1: expected a plan file (JSON), since task 't0' of the instance has a "
            "choice of agents, and other formats do not state who visits it");
  EXPECT_EQ(refusal([&] {
              read("schedule:\n  a0:\n    - x: 1\n      y: 0\n      t: 0\n", instance_with_need());
            }),
            "plan: line 1: expected a plan file (JSON), since task 't0' of the instance has a "
            "choice of agents, and other formats do not state who visits it");
}

// A path shows which of its goals an agent has chosen.
TEST_F(ChoicesExchange, PlansOfOtherToolsChooseGoals) {
  const ClaimedPlan plan =
      read("Agent 0: (0,1)->(0,0)->\nAgent 1: (0,3)->(0,4)->\n", instance_with_goals());
  EXPECT_EQ(plan.solution.plan->cost, 2);
  EXPECT_TRUE(check(instance_with_goals(), plan.solution).empty());
}

TEST_F(ChoicesExchange, PlanFilesTellVisits) {
  const Instance instance = instance_with_need();
  const std::string text = solution_text(instance, solution_with_need());
  EXPECT_NE(text.find(R"("sequence":["t0"],"cost":3,"work":[{"task":"t0","begin":1,"end":1}])"),
            std::string::npos)
      << text;
  EXPECT_EQ(solution_text(instance, read(text, instance).solution), text);
}

// The orders and costs of plans are computed from paths and stated visits.
TEST_F(ChoicesExchange, PlansOfPathsAndVisits) {
  const Instance instance = instance_with_need();
  const Plan plan = plan_of_paths(instance, {{1, 0}, {3, 2, 3, 4}}, {{}, {{0, 1, 1}}});
  EXPECT_EQ(plan.cost, 4);
  EXPECT_EQ(plan.agents[1].sequence, (std::vector<TaskIndex>{0}));
  Solution solution = solution_with_need();
  solution.plan = plan;
  EXPECT_TRUE(check(instance, solution).empty());
  const Plan late = plan_of_paths(instance, {{1, 0}, {3}}, {{}, {{0, 1, 5}}});
  EXPECT_EQ(late.agents[1].cost, 5);
}

TEST_F(ChoicesExchange, NewTasksOfAllAgents) {
  const auto read = [&](const std::string& agents) {
    return read_new_tasks(
        directory_.write("f", R"({"id": "t", "cell": [2, 0], "agents": )" + agents + "}"),
        instance_with_goals());
  };
  EXPECT_EQ(read("\"*\"").front().task.agents, (std::vector<std::string>{"a0", "a1"}));
  EXPECT_EQ(refusal([&] { read("\"all\""); }),
            "f: /agents: found \"all\"; expected a list of ids, or \"*\" for all agents");
}

TEST_F(ChoicesExchange, NewTasksHaveANeed) {
  const auto read = [&](const std::string& need) {
    return read_new_tasks(
        directory_.write("f",
                         R"({"id": "t", "cell": [2, 0], "agents": "*", "need": )" + need + "}"),
        instance_with_goals());
  };
  EXPECT_EQ(read("1").front().task.need, 1);
  EXPECT_EQ(refusal([&] { read("0"); }).substr(0, 10), "f: /need: ");
}

TEST_F(ChoicesExchange, PassingOrdersRefuseChoices) {
  const auto refused_by_order = [](const Instance& instance, const Solution& solution) {
    try {
      const ActionDependencyGraph order(instance, *solution.plan);
    } catch (const InstanceError& error) {
      return error.field() + ": " + error.what();
    }
    return std::string("accepted");
  };
  EXPECT_EQ(
      refused_by_order(instance_with_goals(), solution_with_goals()),
      "agents/0/goals: agent 'a0' has a choice of goals, which passing orders do not support; "
      "expected an instance of 'grove convert --fix-choices', or 'goal'");
  EXPECT_EQ(
      refused_by_order(instance_with_need(), solution_with_need()),
      "tasks/0/need: task 't0' has a choice of agents, which passing orders do not support; "
      "expected an instance of 'grove convert --fix-choices', or no 'need' below the number of its "
      "agents");
}

TEST_F(ChoicesExchange, InstancesWithoutChoicesAreAccepted) {
  const Instance instance = testing::instance_of({"..."}, {{{0, 0}, Position{2, 0}}});
  EXPECT_FALSE(find_choice(instance).has_value());
  EXPECT_NO_THROW(require_no_choices(instance, "is refused"));
}

}  // namespace choices_exchange_test
}  // namespace grove::detail
