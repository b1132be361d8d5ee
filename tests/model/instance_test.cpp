// SPDX-License-Identifier: MIT
#include "model/instance.h"

#include <gtest/gtest.h>

#include <functional>

namespace grove::detail {
namespace instance_test {

using Ids = std::vector<std::string>;

// . . . .
// @ . . .
InstanceBuilder builder() {
  return InstanceBuilder(Grid(4, 2, {true, true, true, true, false, true, true, true}));
}

// Returns the field of the InstanceError that `act` throws, or "nothing" if it throws none.
std::string refused_field(const std::function<void()>& act) {
  try {
    act();
  } catch (const InstanceError& error) {
    EXPECT_STRNE(error.what(), "");
    return error.field();
  }
  return "nothing";
}

TEST(InstanceBuilder, GivesTasksToTheirAgentsInOrder) {
  auto b = builder();
  b.add_agent("a", {0, 0}, Position{3, 0});
  b.add_agent("b", {1, 0}, std::nullopt);
  b.add_task("t0", {2, 0}, Ids{"b", "a"});
  b.add_task("t1", {3, 1}, Ids{"a"});
  const Instance instance = std::move(b).build();
  EXPECT_EQ(instance.agent(0).tasks, (std::vector<TaskIndex>{0, 1}));
  EXPECT_EQ(instance.agent(1).tasks, (std::vector<TaskIndex>{0}));
  EXPECT_EQ(instance.task(0).agents, (std::vector<AgentIndex>{1, 0}));
  EXPECT_FALSE(instance.agent(1).goal);
}

TEST(InstanceBuilder, AllowsTasksOnStartsAndDestinations) {
  auto b = builder();
  b.add_agent("a", {0, 0}, Position{3, 0});
  b.add_agent("b", {1, 0}, Position{0, 0});
  b.add_task("t0", {0, 0}, Ids{"b"});
  b.add_task("t1", {3, 0}, Ids{"b"});
  EXPECT_EQ(std::move(b).build().task_count(), 2);
}

TEST(InstanceBuilder, RefusesBadAgents) {
  auto b = builder();
  b.add_agent("a", {0, 0}, Position{3, 0});
  EXPECT_EQ(refused_field([&] { b.add_agent("", {1, 0}, std::nullopt); }), "id");
  EXPECT_EQ(refused_field([&] { b.add_agent("a", {1, 0}, std::nullopt); }), "id");
  EXPECT_EQ(refused_field([&] { b.add_agent("b", {0, 0}, std::nullopt); }), "start");
  EXPECT_EQ(refused_field([&] { b.add_agent("b", {0, 1}, std::nullopt); }), "start");
  EXPECT_EQ(refused_field([&] { b.add_agent("b", {-1, 0}, std::nullopt); }), "start");
  EXPECT_EQ(refused_field([&] { b.add_agent("b", {1, 0}, Position{3, 0}); }), "goal");
  AgentSpec turning;
  turning.id = "b";
  turning.start.place = 1;
  turning.motion.turn_steps = 2;
  turning.start.to = Heading::kEast;
  turning.start.steps = 2;
  EXPECT_EQ(refused_field([&] { b.add_agent(turning); }), "start") << "the turn has only 2 steps";
  EXPECT_EQ(refused_field([&] { b.add_agent("b", {1, 0}, Position{4, 0}); }), "goal");
}

TEST(InstanceBuilder, RefusesBadTasks) {
  auto b = builder();
  b.add_agent("a", {0, 0}, Position{3, 0});
  b.add_task("t", {1, 0}, Ids{"a"});
  EXPECT_EQ(refused_field([&] { b.add_task("t", {2, 0}, Ids{"a"}); }), "id");
  EXPECT_EQ(refused_field([&] { b.add_task("u", {0, 1}, Ids{"a"}); }), "cell");
  EXPECT_EQ(refused_field([&] { b.add_task("u", {2, 0}, Ids{}); }), "agents");
  EXPECT_EQ(refused_field([&] { b.add_task("u", {2, 0}, Ids{"a", "z"}); }), "agents/1");
  EXPECT_EQ(refused_field([&] { b.add_task("u", {2, 0}, Ids{"a", "a"}); }), "agents/1");
  EXPECT_EQ(refused_field([&] { b.add_task("u", {2, 0}, Ids{"a"}, -1); }), "duration");
  EXPECT_EQ(refused_field([&] { b.add_task("u", {2, 0}, Ids{"a"}, 1 << 17); }), "duration");
}

TEST(InstanceBuilder, RefusesMoreTasksThanAMaskHolds) {
  InstanceBuilder b(Grid(70, 1, std::vector<bool>(70, true)));
  b.add_agent("a", {0, 0}, std::nullopt);
  for (int k = 0; k < kMaxTasksPerAgent; ++k) b.add_task("t" + std::to_string(k), {k, 0}, Ids{"a"});
  EXPECT_EQ(refused_field([&] { b.add_task("last", {69, 0}, Ids{"a"}); }), "agents/0");
}

TEST(InstanceBuilder, RefusesInstancesWithoutAgents) {
  EXPECT_EQ(refused_field([] { builder().build(); }), "agents");
}

TEST(InstanceBuilder, AgentWithoutGoalsRestsAnywhere) {
  auto b = builder();
  b.add_agent("a", {0, 0}, std::nullopt);
  const Instance instance = std::move(b).build();
  EXPECT_TRUE(instance.agent(0).is_idle());
  EXPECT_TRUE(instance.may_rest(0, 3));
}

// One stop represents all tasks on a place that take no time.
TEST(InstanceBuilder, StopsRepresentAllTasksOnAPlace) {
  auto b = builder();
  b.add_agent("a", {0, 0}, Position{3, 0});
  b.add_agent("b", {1, 0}, std::nullopt);
  b.add_task("t0", {2, 0}, Ids{"a", "b"});
  b.add_task("t1", {2, 0}, Ids{"a"});
  b.add_task("t2", {1, 0}, Ids{"a"});
  b.add_task("t3", {1, 0}, Ids{"a"}, 3);
  b.add_task("t4", {1, 0}, Ids{"a"}, 1);
  const Instance instance = std::move(b).build();
  EXPECT_EQ(instance.agent(0).stops, (std::vector<TaskIndex>{0, 3, 4}));
  EXPECT_EQ(instance.agent(1).stops, (std::vector<TaskIndex>{0}));
  const std::vector<std::uint8_t> order{2, 0, 1};
  EXPECT_EQ(instance.tasks_in_order(0, order), (std::vector<TaskIndex>{4, 1, 0, 2, 3}));
  EXPECT_FALSE(instance.rests_on_last_stop(0));
  EXPECT_TRUE(instance.rests_on_last_stop(1));
}

TEST(InstanceBuilder, AgentThatMayLeaveOutStopsHasOneWithoutTime) {
  auto b = builder();
  b.may_leave_out_stops(b.add_agent("a", {0, 0}, Position{3, 0}));
  b.add_agent("b", {1, 0}, Position{2, 0});
  b.add_task("t0", {1, 0}, Ids{"a", "b"}, 3);
  b.add_task("t1", {1, 0}, Ids{"a", "b"});
  b.add_task("t2", {1, 0}, Ids{"a", "b"});
  const Instance instance = std::move(b).build();
  EXPECT_EQ(instance.agent(0).stops, (std::vector<TaskIndex>{0, 1}));
  EXPECT_EQ(instance.agent(1).stops, (std::vector<TaskIndex>{0}));
}

}  // namespace instance_test
}  // namespace grove::detail
