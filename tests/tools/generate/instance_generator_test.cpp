// SPDX-License-Identifier: MIT
#include "tools/generate/instance_generator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/input_error.h"
#include "tests/support/refusal.h"
#include "tools/generate/map_generator.h"
#include "tools/generate/scenario_generator.h"

namespace grove::detail {
namespace instance_generator_test {

const Grid& grid() {
  static const Grid grid = empty_map(12, 10);
  return grid;
}

Scenario scenario(int rows = 100) {
  return {"m.scen", random_scenario(grid(), "m.map", rows, 3, "rows")};
}

Instance generate(const InstanceRequest& request) {
  return generate_instance(grid(), scenario(), request);
}

TEST(GenerateInstance, TakesTasksFromRow21On) {
  const Instance instance = generate({.agents = 5, .tasks = 10, .seed = 1});
  const auto rows = scenario().rows;
  ASSERT_EQ(instance.agent_count(), 5);
  ASSERT_EQ(instance.task_count(), 10);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(instance.agent(i).id, "a" + std::to_string(i));
    EXPECT_EQ(instance.agent(i).start, grid().cell(rows[i].start));
    EXPECT_EQ(instance.agent(i).goal, grid().cell(rows[i].goal));
  }
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(instance.task(k).id, "t" + std::to_string(k));
    EXPECT_EQ(instance.task(k).cell, grid().cell(rows[20 + k].start));
    EXPECT_GE(instance.task(k).agents.size(), 1U);
    EXPECT_LE(instance.task(k).agents.size(), 3U);
  }
}

TEST(GenerateInstance, ReservesMoreRowsForMoreAgents) {
  const Instance instance = generate({.agents = 30, .tasks = 2});
  EXPECT_EQ(instance.task(0).cell, grid().cell(scenario().rows[30].start));
}

TEST(GenerateInstance, GivesTasksToOneTwoAndThreeAgents) {
  const Instance instance = generate({.agents = 20, .tasks = 80, .seed = 2});
  std::vector<int> counts(4);
  for (const Task& task : instance.tasks()) ++counts[task.agents.size()];
  for (int k = 1; k <= 3; ++k) EXPECT_GT(counts[k], 10);
}

TEST(GenerateInstance, GivesASingleAgentAllTasks) {
  EXPECT_EQ(generate({.agents = 1, .tasks = 20}).agent(0).tasks.size(), 20U);
}

TEST(GenerateInstance, WithMgTurnsGoalsIntoTasks) {
  const InstanceRequest request{.agents = 20, .tasks = 80, .seed = 4};
  InstanceRequest mg_request = request;
  mg_request.mg = true;
  const Instance with_goals = generate(request);
  const Instance mg = generate(mg_request);
  int joined = 0;
  for (AgentIndex i = 0; i < 20; ++i) {
    EXPECT_FALSE(mg.agent(i).goal);
    std::vector<Cell> cells;
    for (TaskIndex task : mg.agent(i).tasks) cells.push_back(mg.task(task).cell);
    EXPECT_NE(std::ranges::find(cells, *with_goals.agent(i).goal), cells.end());
    for (const Task& task : with_goals.tasks()) joined += task.cell == *with_goals.agent(i).goal;
  }
  EXPECT_GT(joined, 0);  // a goal on the cell of a task adds no task
  EXPECT_EQ(mg.task_count(), 80 + 20 - joined);
}

TEST(GenerateInstance, ExtrasChangeNothingElse) {
  InstanceRequest request{.agents = 20, .tasks = 40, .seed = 1};
  const Instance plain = generate(request);
  request.extras = {.turn_steps = 2, .goal_headings = true, .durations = {.min = 1, .max = 3}};
  const Instance with_extras = generate(request);
  std::vector<int> of_heading(4);
  std::vector<int> of_goal_heading(4);
  for (AgentIndex i = 0; i < 20; ++i) {
    const Agent& agent = with_extras.agent(i);
    const Pose start = with_extras.pose_of(agent.start);
    EXPECT_EQ(start.place, plain.agent(i).start);
    EXPECT_EQ(start.steps, 0);
    EXPECT_EQ(agent.goal, plain.agent(i).goal);
    EXPECT_EQ(agent.tasks, plain.agent(i).tasks);
    EXPECT_EQ(agent.motion, Motion{2});
    ++of_heading[static_cast<int>(start.heading)];
    ++of_goal_heading[static_cast<int>(agent.goal_heading.value())];
  }
  EXPECT_GT(*std::ranges::min_element(of_heading), 0);
  EXPECT_GT(*std::ranges::min_element(of_goal_heading), 0);
  std::vector<int> of_duration(4);
  for (TaskIndex k = 0; k < 40; ++k) {
    EXPECT_EQ(with_extras.task(k).cell, plain.task(k).cell);
    EXPECT_EQ(plain.task(k).duration, 0);
    ++of_duration[with_extras.task(k).duration];
  }
  EXPECT_EQ(of_duration[0], 0);
  EXPECT_GT(*std::ranges::min_element(of_duration.begin() + 1, of_duration.end()), 5);
}

TEST(GenerateInstance, DrawsHeadingsAndDurationsIndependently) {
  InstanceRequest request{.agents = 10, .tasks = 30, .seed = 7, .extras = {.turn_steps = 1}};
  const Instance turning = generate(request);
  request.extras.goal_headings = true;
  request.extras.durations = {.min = 0, .max = 10};
  const Instance both = generate(request);
  request.extras = {.durations = {.min = 0, .max = 10}};
  const Instance slow = generate(request);
  for (AgentIndex i = 0; i < 10; ++i) {
    EXPECT_FALSE(turning.agent(i).goal_heading);
    EXPECT_FALSE(slow.agent(i).goal_heading);
    EXPECT_EQ(turning.pose_of(turning.agent(i).start), both.pose_of(both.agent(i).start));
  }
  for (TaskIndex k = 0; k < 30; ++k) EXPECT_EQ(slow.task(k).duration, both.task(k).duration);
}

TEST(GenerateInstance, WithANeedAnyAgentMayVisitATask) {
  InstanceRequest request{.agents = 20, .tasks = 80, .seed = 1};
  const Instance plain = generate(request);
  request.choices.need = 2;
  const Instance any = generate(request);
  request.choices.eligible = 5;
  const Instance some = generate(request);
  std::vector<int> of_agent(20);
  for (TaskIndex k = 0; k < 80; ++k) {
    EXPECT_EQ(any.task(k).cell, plain.task(k).cell);
    EXPECT_EQ(any.task(k).need, 2);
    EXPECT_EQ(any.task(k).agents.size(), 20U);
    EXPECT_EQ(some.task(k).need, 2);
    EXPECT_EQ(some.task(k).agents.size(), 5U);
    EXPECT_TRUE(std::ranges::is_sorted(some.task(k).agents));
    for (const AgentIndex agent : some.task(k).agents) ++of_agent[agent];
  }
  EXPECT_GT(*std::ranges::min_element(of_agent), 5);
  for (AgentIndex i = 0; i < 20; ++i) {
    EXPECT_EQ(any.agent(i).start, plain.agent(i).start);
    EXPECT_EQ(any.agent(i).goal, plain.agent(i).goal);
    EXPECT_TRUE(any.agent(i).tasks.empty());
  }
}

TEST(GenerateInstance, AShareOfTheTasksGetsTheNeed) {
  InstanceRequest request{.agents = 10, .tasks = 41, .seed = 5};
  const Instance plain = generate(request);
  request.choices = {.need = 1, .eligible = 3};
  const Instance all = generate(request);
  std::vector<bool> had_need(41);
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    request.choices.need_share = share;
    const Instance instance = generate(request);
    int needs = 0;
    for (TaskIndex k = 0; k < 41; ++k) {
      const Task& task = instance.task(k);
      const bool has_need = !task.needs_all();
      needs += has_need;
      // A larger share adds tasks and changes nothing else.
      EXPECT_TRUE(has_need || !had_need[k]);
      had_need[k] = has_need;
      EXPECT_EQ(task.agents, has_need ? all.task(k).agents : plain.task(k).agents);
    }
    EXPECT_EQ(needs, share_of(share, 41));
  }
  EXPECT_EQ(share_of(0.5, 41), 21);
}

TEST(GenerateInstance, WithMgAnAgentMustVisitItsDestinationDespiteANeed) {
  InstanceRequest request{.agents = 20, .tasks = 80, .seed = 4};
  const Instance with_goals = generate(request);
  request.mg = true;
  request.choices.need = 1;
  const Instance mg = generate(request);
  EXPECT_EQ(mg.task_count(), 100);
  for (AgentIndex i = 0; i < 20; ++i) {
    ASSERT_EQ(mg.agent(i).tasks.size(), 1U);
    EXPECT_EQ(mg.task(mg.agent(i).tasks[0]).cell, with_goals.agent(i).goal);
    EXPECT_EQ(mg.agent(i).options.size(), 80U);
  }
}

// Returns the destinations of each agent in `instance` by the agents that drew them, and checks
// that each agent may take its own.
std::vector<std::vector<int>> owners_of_goals(const Instance& instance) {
  const auto rows = scenario().rows;
  std::vector<std::vector<int>> owners;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    std::vector<Place> goals = agent.goals;
    if (agent.goal) goals.push_back(*agent.goal);
    std::vector<int>& of_agent = owners.emplace_back();
    for (int k = 0; k < instance.agent_count(); ++k)
      if (std::ranges::count(goals, grid().cell(rows[k].goal)) > 0) of_agent.push_back(k);
    EXPECT_EQ(of_agent.size(), goals.size());
    EXPECT_EQ(std::ranges::count(of_agent, i), 1);
  }
  return owners;
}

TEST(GenerateInstance, AgentsChooseAnyDestination) {
  const Instance instance = generate({.agents = 20, .choices = {.goals = GoalChoice::kAny}});
  for (const auto& owners : owners_of_goals(instance)) EXPECT_EQ(owners.size(), 20U);
  // An agent alone has no choice.
  EXPECT_TRUE(generate({.agents = 1, .choices = {.goals = GoalChoice::kAny}}).agent(0).goal);
}

TEST(GenerateInstance, AgentsChooseSomeDestinations) {
  InstanceRequest request{
      .agents = 20, .seed = 2, .choices = {.goals = GoalChoice::kSome, .goal_count = 5}};
  std::vector<int> of_owner(20);
  for (const auto& owners : owners_of_goals(generate(request))) {
    EXPECT_EQ(owners.size(), 5U);
    for (const int owner : owners) ++of_owner[owner];
  }
  EXPECT_NE(std::ranges::count(of_owner, 5), 20);
  request.choices.goal_count = 20;
  for (const auto& owners : owners_of_goals(generate(request))) EXPECT_EQ(owners.size(), 20U);
}

TEST(GenerateInstance, GroupsShareTheirDestinations) {
  const auto owners = owners_of_goals(generate(
      {.agents = 20, .seed = 2, .choices = {.goals = GoalChoice::kGroups, .goal_count = 3}}));
  std::vector<std::vector<int>> groups = owners;
  std::ranges::sort(groups);
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  ASSERT_EQ(groups.size(), 3U);
  for (const auto& group : groups) {
    EXPECT_TRUE(group.size() == 6 || group.size() == 7);
    for (const int agent : group) EXPECT_EQ(owners[agent], group);
  }
}

TEST(GenerateInstance, AShareOfTheAgentsChooseAmongEachOthersDestinations) {
  for (const GoalChoice goals : {GoalChoice::kAny, GoalChoice::kSome, GoalChoice::kGroups}) {
    const InstanceRequest request{
        .agents = 20, .seed = 3, .choices = {.goals = goals, .goal_count = 2, .goal_share = 0.4}};
    const Instance instance = generate(request);
    const auto has_choice = [&](int agent) { return !instance.agent(agent).goals.empty(); };
    int choosers = 0;
    for (const auto& owners : owners_of_goals(instance)) {
      choosers += owners.size() > 1;
      EXPECT_TRUE(owners.size() == 1 || std::ranges::all_of(owners, has_choice));
    }
    EXPECT_EQ(choosers, 8);
  }
}

TEST(GenerateInstance, ChoicesDependOnTheSeedAndChangeNothingElse) {
  InstanceRequest request{.agents = 20, .tasks = 40, .seed = 1};
  request.extras = {.turn_steps = 1, .goal_headings = true, .durations = {.min = 1, .max = 9}};
  const Instance plain = generate(request);
  request.choices = {
      .need = 1, .eligible = 4, .goals = GoalChoice::kSome, .goal_count = 3, .goal_share = 0.5};
  const Instance instance = generate(request);
  EXPECT_EQ(owners_of_goals(instance), owners_of_goals(generate(request)));
  for (AgentIndex i = 0; i < 20; ++i) {
    EXPECT_EQ(instance.pose_of(instance.agent(i).start), plain.pose_of(plain.agent(i).start));
    EXPECT_EQ(instance.agent(i).goal_heading, plain.agent(i).goal_heading);
  }
  for (TaskIndex k = 0; k < 40; ++k) EXPECT_EQ(instance.task(k).duration, plain.task(k).duration);
  request.seed = 2;
  const Instance other = generate(request);
  EXPECT_NE(owners_of_goals(instance), owners_of_goals(other));
  int same = 0;
  for (TaskIndex k = 0; k < 40; ++k) same += instance.task(k).agents == other.task(k).agents;
  EXPECT_LT(same, 20);
}

TEST(Choices, HaveDistinctSuffixes) {
  EXPECT_EQ(Choices{}.suffix(), "");
  EXPECT_EQ((Choices{.need = 1}).suffix(), "_need1");
  EXPECT_EQ((Choices{.need = 2, .eligible = 5, .need_share = 0.5}).suffix(), "_need2of5-50pc");
  EXPECT_EQ((Choices{.goals = GoalChoice::kAny}).suffix(), "_anygoal");
  EXPECT_EQ((Choices{.goals = GoalChoice::kSome, .goal_count = 5}).suffix(), "_goals5");
  EXPECT_EQ((Choices{.need = 1, .goals = GoalChoice::kGroups, .goal_count = 4, .goal_share = 0.125})
                .suffix(),
            "_need1_groups4-12.5pc");
}

TEST(Extras, HaveDistinctSuffixes) {
  EXPECT_EQ(Extras{}.suffix(), "");
  EXPECT_EQ((Extras{.turn_steps = 1}).suffix(), "_turning");
  EXPECT_EQ((Extras{.turn_steps = 2, .goal_headings = true}).suffix(), "_turning2_headings");
  EXPECT_EQ((Extras{.turn_steps = 1, .durations = {.min = 0, .max = 10}}).suffix(),
            "_turning_d0-10");
}

TEST(GenerateInstance, SkipsRepeatedTaskCells) {
  Scenario repeated = scenario(24);
  repeated.rows[21].start = repeated.rows[20].start;
  const Instance instance = generate_instance(grid(), repeated, {.agents = 2, .tasks = 3});
  EXPECT_EQ(instance.task(1).cell, grid().cell(repeated.rows[22].start));
}

TEST(GenerateInstance, GivesTasksOnlyToAgentsThatCanReachThem) {
  // Agents and tasks are on both sides of a wall.
  std::vector<bool> passable(30, true);
  for (int y = 0; y < 10; ++y) passable[3 * y + 1] = false;
  const Grid split(3, 10, passable);
  Scenario rows{"m.scen", {}};
  for (int k = 0; k < 20; ++k) {
    const Position p{k < 10 ? 0 : 2, k % 10};
    rows.rows.push_back({k, "m.map", 3, 10, p, p});
  }
  std::swap(rows.rows[1], rows.rows[10]);
  for (int k = 0; k < 8; ++k) rows.rows.push_back({k, "m.map", 3, 10, {k % 2 * 2, k / 2}, {0, 0}});
  const InstanceRequest request{.agents = 2, .tasks = 8, .seed = 1};
  InstanceRequest with_need = request;
  with_need.choices.need = 1;
  EXPECT_EQ(generate_instance(split, rows, with_need).task(0).agents.size(), 1U);
  with_need.choices.need = 2;
  EXPECT_EQ(refusal([&] { generate_instance(split, rows, with_need); }),
            "m.scen: task 't0' can be reached by 1 of the agents; expected at least 2");
  const Instance instance = generate_instance(split, rows, request);
  for (const Task& task : instance.tasks())
    for (AgentIndex agent : task.agents)
      EXPECT_EQ(split.position(task.cell).x, split.position(instance.agent(agent).start).x);
}

TEST(GenerateInstance, RefusesTooLargeCounts) {
  const auto refused = [](const Scenario& from, const InstanceRequest& request) -> std::string {
    try {
      generate_instance(grid(), from, request);
      return "accepted";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refused(scenario(4), {.agents = 5}),
            "m.scen: has 4 rows; expected at least 5, one for each agent");
  EXPECT_EQ(refused(scenario(25), {.agents = 5, .tasks = 6}),
            "m.scen: has 25 rows, enough for 5 of 6 tasks; they are taken from row 21 on");
  EXPECT_EQ(refused(scenario(), {.agents = 1, .tasks = 70}),
            "m.scen: 70 tasks for 1 agents do not fit: agent 'a0' must visit more than 64 tasks; "
            "expected "
            "at most 64");
  Scenario outside = scenario();
  outside.rows[1].goal = {99, 0};
  EXPECT_EQ(refused(outside, {.agents = 2, .mg = true}).substr(0, 22), "m.scen: line 3, goal: ");
}

}  // namespace instance_generator_test
}  // namespace grove::detail
