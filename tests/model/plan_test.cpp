// SPDX-License-Identifier: MIT
#include "model/plan.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grove::detail {
namespace plan_test {

TEST(Status, FollowsFromCostBoundAndOmega) {
  const Omega one_percent = Omega::parse("0.01");
  EXPECT_EQ(status_of(std::nullopt, 10, one_percent), Status::kUnknown);
  EXPECT_EQ(status_of(100, 100, one_percent), Status::kOptimal);
  EXPECT_EQ(status_of(101, 100, one_percent), Status::kBounded);
  EXPECT_EQ(status_of(102, 100, one_percent), Status::kFeasible);
  EXPECT_EQ(status_of(100, 99, Omega()), Status::kFeasible);
}

TEST(Status, IsNeverBoundedWithInfiniteOmega) {
  EXPECT_EQ(status_of(101, 100, Omega::infinite()), Status::kFeasible);
  EXPECT_EQ(status_of(100, 100, Omega::infinite()), Status::kOptimal);
}

TEST(Status, NamesRoundTrip) {
  for (Status status : {Status::kOptimal, Status::kBounded, Status::kFeasible, Status::kInfeasible,
                        Status::kUnknown})
    EXPECT_EQ(parse_status(to_string(status)), status);
  EXPECT_FALSE(parse_status("solved"));
}

// In the first plan the agent executes both tasks at its start, in the middle of a turn. In the
// second plan it executes one of them in the middle of a later turn, as other solvers can do.
TEST(WalkedPath, KeepsTheTaskExecutionsOfThePlan) {
  InstanceBuilder builder(Map(Grid(2, 1, {true, true})));
  builder.add_agent({.id = "a",
                     .start = {0, Heading::kEast, Heading::kSouth, 1},
                     .goal = Place{0},
                     .motion = {2}});
  const std::vector<std::string> agents{"a"};
  builder.add_task("t0", Place{0}, agents, 2);
  builder.add_task("t1", Place{0}, agents, 3);
  const Instance instance = std::move(builder).build();
  const State start = instance.world().base(instance.agent(0).start);
  const auto state = [&](Heading from, Heading to, Time steps) {
    return instance.state_of(0, {0, from, to, steps});
  };
  const auto completed = [&](const Path& path) {
    std::vector<TaskIndex> tasks;
    for (const State s : path)
      for (const TaskIndex t : {0, 1})
        if (instance.is_visited(t, s) && std::ranges::count(tasks, t) == 0) tasks.push_back(t);
    return tasks;
  };
  const AgentPlan at_once{
      .cost = 5, .sequence = {0, 1}, .path = Path(6, start), .work = {{0, 0, 2}, {1, 2, 5}}};
  EXPECT_EQ(completed(walked_path(instance, 0, at_once)), (std::vector<TaskIndex>{0, 1}));

  const State south = state(Heading::kSouth, Heading::kSouth, 0);
  const State turning = state(Heading::kSouth, Heading::kWest, 1);
  const State west = state(Heading::kWest, Heading::kWest, 0);
  const AgentPlan later{
      .cost = 8,
      .sequence = {0, 1},
      .path = {start, start, start, south, turning, turning, turning, turning, west},
      .work = {{0, 0, 2}, {1, 4, 7}}};
  EXPECT_EQ(completed(walked_path(instance, 0, later)), (std::vector<TaskIndex>{0, 1}));
}

}  // namespace plan_test
}  // namespace grove::detail
