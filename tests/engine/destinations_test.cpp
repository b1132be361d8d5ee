// SPDX-License-Identifier: MIT
// Tests the choice of destinations for agents with more tasks than a cost-to-go table can hold. For
// these agents the costs of ending on each task are computed incrementally. Compares the result
// with Held-Karp and an enumeration of all choices. (tests/fuzz/methods_test.cpp covers fewer
// tasks.)
#include "engine/destinations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "model/distance_field.h"
#include "model/tuning.h"
#include "sequencing/rtsp.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace destinations_test {

constexpr int kTasks = 15;
// With seed 233 the best choice uses an end that costs more than the first limit (kFirstReach in
// src/engine/destinations.cpp).
constexpr int kFirstSeed = 230;

// Returns, for each task, the cost of the agent's best sequence that ends with it (Held-Karp).
std::vector<Cost> costs_of_ends(const Instance& instance, AgentIndex agent) {
  std::vector<std::vector<Time>> distances;
  std::vector<Cell> cells;
  for (TaskIndex task : instance.agent(agent).tasks) {
    cells.push_back(instance.task(task).cell);
    distances.push_back(distance_field(instance.grid(), cells.back()));
  }
  const std::size_t n = cells.size();
  std::vector<Cost> least(n << n, kInfiniteCost);  // index: set visited, then last task
  for (std::size_t i = 0; i < n; ++i)
    least[(std::size_t{1} << i) * n + i] = distances[i][instance.agent(agent).start];
  for (std::size_t set = 1; set < std::size_t{1} << n; ++set)
    for (std::size_t last = 0; last < n; ++last)
      for (std::size_t next = 0; next < n && least[set * n + last] < kInfiniteCost; ++next)
        if ((set >> next & 1) == 0) {
          Cost& there = least[(set | std::size_t{1} << next) * n + next];
          there = std::min(there, least[set * n + last] + distances[last][cells[next]]);
        }
  return {least.end() - static_cast<std::ptrdiff_t>(n), least.end()};
}

// Two agents that share most of their tasks.
Instance pair_of_agents(unsigned seed) {
  std::mt19937 random(seed);
  const int side = 7 + static_cast<int>(seed % 6);
  std::vector<std::string> rows(side, std::string(side, '.'));
  std::vector<Position> cells;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (y % 2 == 1 && x > 0 && random() % 3 == 0)
        rows[y][x] = '@';
      else
        cells.push_back({x, y});
  std::ranges::shuffle(cells, random);
  std::vector<testing::AgentSpec> agents(2);
  for (int agent = 0; agent < 2; ++agent) {
    agents[agent].start = cells[agent];
    const int unshared = static_cast<int>(seed % 4);
    for (int task = 0; task < kTasks; ++task)
      agents[agent].tasks.push_back(cells[2 + task + (task < unshared ? agent * kTasks : 0)]);
  }
  return testing::instance_of(rows, agents);
}

TEST(Destinations, AreTheCheapestDistinctEndsOfManyTasks) {
  static_assert(kTasks > kTableStops);
  const int end = kFirstSeed + testing::fuzz_rounds(8);
  for (int seed = kFirstSeed; seed < end; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = pair_of_agents(static_cast<unsigned>(seed));
    const Problem problem(instance, Limits());
    const auto chosen = choose_destinations(problem, Tuning().visitor_steps, Limits());
    ASSERT_TRUE(chosen);
    const std::vector<Cost> ends[] = {costs_of_ends(instance, 0), costs_of_ends(instance, 1)};
    const auto cost_with_visitors = [&](AgentIndex agent, int stop) {
      const TaskIndex task = instance.agent(agent).tasks[stop];
      return ends[agent][stop] +
             Tuning().visitor_steps * (std::ssize(instance.task(task).agents) - 1);
    };
    Cost best = kInfiniteCost;
    Cost cost = kInfiniteCost;  // cost of the chosen destinations
    for (int i = 0; i < kTasks; ++i)
      for (int j = 0; j < kTasks; ++j) {
        const TaskIndex tasks[] = {instance.agent(0).tasks[i], instance.agent(1).tasks[j]};
        if (tasks[0] == tasks[1]) continue;
        best = std::min(best, cost_with_visitors(0, i) + cost_with_visitors(1, j));
        if (std::ranges::equal(tasks, chosen->tasks))
          cost = cost_with_visitors(0, i) + cost_with_visitors(1, j);
      }
    EXPECT_EQ(cost, best);
    EXPECT_EQ(chosen->bound, std::ranges::min(ends[0]) + std::ranges::min(ends[1]));
  }
}

// Two agents cannot both rest on a place where each has a task of its own.
TEST(Destinations, AreOnDifferentPlaces) {
  InstanceBuilder builder(Grid(5, 2, std::vector<bool>(10, true)));
  builder.add_agent("a", Position{0, 0}, std::nullopt);
  builder.add_agent("b", Position{4, 0}, std::nullopt);
  const std::string a[] = {"a"};
  const std::string b[] = {"b"};
  builder.add_task("shared-place-a", Position{2, 0}, a);
  builder.add_task("shared-place-b", Position{2, 0}, b);
  builder.add_task("other", Position{0, 1}, a);
  const Instance instance = std::move(builder).build();
  const Problem problem(instance, Limits());
  const auto chosen = choose_destinations(problem, Tuning().visitor_steps, Limits());
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->tasks, (std::vector<TaskIndex>{2, 1}));
  const Instance with = with_destinations(instance, *chosen);
  EXPECT_EQ(with.agent(0).goal, instance.task(2).cell);
  EXPECT_EQ(with.agent(1).goal, instance.task(1).cell);
}

}  // namespace destinations_test
}  // namespace grove::detail
