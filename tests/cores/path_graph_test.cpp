// SPDX-License-Identifier: MIT
#include "cores/path_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "planning/free_order_sipp.h"
#include "planning/problem.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace path_graph_test {

// Returns the number of nodes in which the agent executes a task. Each of them must be its own.
int check_work(const Instance& instance, AgentIndex agent) {
  const Limits limits;
  const Problem problem(instance, limits);
  AgentStops stops(instance, problem.distances, agent);
  SequenceStages goals(stops, SequenceClass{});
  Path path;
  const World& world = instance.world();
  if (FreeOrderSipp(world).find(goals, PathQuery{}, limits, path) != PathOutcome::kFound) return 0;
  PathGraph graph(stops, static_cast<Time>(path.size()) - 1);
  EXPECT_EQ(graph.grow(3, 1'000'000, 1'000'000, limits), PathGraph::Outcome::kGrown);
  int working = 0;
  for (PathGraph::Node node = 0; node < graph.count(); ++node) {
    if (!world.is_working(graph.state(node))) continue;
    ++working;
    const TaskIndex task = world.work(graph.state(node)).task;
    EXPECT_EQ(std::ranges::count(instance.agent(agent).stops, task), 1);
  }
  return working;
}

TEST(PathGraph, AgentsExecuteOnlyTheirOwnTasks) {
  int working = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(300));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = fuzz::any_instance(seed).build();
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      working += check_work(instance, agent);
  }
  EXPECT_GT(working, 1000);
}

// Agent 0 has a plain task on the place of a task of agent 1 that takes time.
TEST(PathGraph, PlainTaskOnThePlaceOfAnotherAgentsTask) {
  fuzz::TinyInstance instance;
  instance.rows = {"...", "..."};
  instance.agents = {{.start = {0, 1}, .goal = {{0, 1}}}, {.start = {2, 0}, .goal = {{1, 0}}}};
  instance.tasks = {{.cell = {0, 1}, .agents = {0}},
                    {.cell = {0, 1}, .agents = {1}, .duration = 1},
                    {.cell = {2, 1}, .agents = {0}, .duration = 1}};
  EXPECT_GT(check_work(instance.build(), 0), 0);
}

}  // namespace path_graph_test
}  // namespace grove::detail
