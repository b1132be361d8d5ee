// SPDX-License-Identifier: MIT
#include "tools/solve/assignment_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace grove::detail {
namespace assignment_summary_test {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kWidth = 40;

InstanceBuilder builder() {
  return InstanceBuilder(Grid(kWidth, 1, std::vector<bool>(kWidth, true)));
}

// The plan in which all agents stay at their starts, with these tasks.
Plan plan_of(const Instance& instance, const std::vector<std::vector<TaskIndex>>& tasks) {
  Plan plan;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    plan.agents.push_back({0, tasks[static_cast<std::size_t>(i)], {instance.agent(i).start}});
  return plan;
}

TEST(AssignmentSummary, IsEmptyWithoutChoices) {
  InstanceBuilder made = builder();
  made.add_agent("a", Place{0}, Place{1});
  const Instance instance = std::move(made).build();
  EXPECT_THAT(assignment_summary(instance, plan_of(instance, {{}})), IsEmpty());
}

TEST(AssignmentSummary, ListsTasksInOrderAndDestinations) {
  InstanceBuilder made = builder();
  made.add_agent("a", Place{0}, std::nullopt);
  made.add_agent({.id = "b", .start = {.place = 3}, .goal = {}, .goals = {3, 4}});
  made.add_agent("c", Place{5}, Place{6});
  made.add_agent("d", Place{7}, std::nullopt);
  const std::vector<std::string> all{"a", "b", "c", "d"};
  made.add_task("t", Place{1}, all, 0, 1);
  made.add_task("u", Place{2}, all, 0, 1);
  const Instance instance = std::move(made).build();
  EXPECT_THAT(assignment_summary(instance, plan_of(instance, {{1, 0}, {}, {}, {}})),
              ElementsAre("Assignment    a: u, t -> [0, 0]",  //
                          "              b: no task -> [3, 0]", "              no task: c, d"));
}

TEST(AssignmentSummary, LongListsAreCut) {
  InstanceBuilder made = builder();
  std::vector<std::string> all;
  for (Place i = 0; i < 30; ++i) {
    all.push_back("robot" + std::to_string(i));
    made.add_agent(all.back(), i, std::nullopt);
  }
  std::vector<TaskIndex> tasks;
  for (int i = 0; i < 40; ++i) {
    tasks.push_back(i);
    made.add_task("task" + std::to_string(i), Place{1}, all, 0, 1);
  }
  const Instance instance = std::move(made).build();
  std::vector<std::vector<TaskIndex>> of_agents(30, std::vector<TaskIndex>{0});
  of_agents[0] = tasks;
  of_agents[29].clear();
  const auto lines = assignment_summary(instance, plan_of(instance, of_agents));
  ASSERT_THAT(lines, SizeIs(14));
  EXPECT_THAT(lines[0], HasSubstr("robot0: task0, task1, "));
  EXPECT_THAT(lines[0], HasSubstr(", ... (40 tasks) -> [0, 0]"));
  EXPECT_EQ(lines[12], "              17 more agents: see the plan file");
  EXPECT_EQ(lines[13], "              no task: robot29");
  EXPECT_THAT(lines, Each(::testing::ResultOf([](const std::string& line) { return line.size(); },
                                              ::testing::Le(140u))));
}

}  // namespace assignment_summary_test
}  // namespace grove::detail
