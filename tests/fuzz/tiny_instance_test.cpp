// SPDX-License-Identifier: MIT
#include "tests/fuzz/tiny_instance.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "tests/fuzz/random_instance.h"

namespace grove::detail::fuzz {
namespace tiny_instance_test {

TEST(TinyInstance, ParsesCommentsAndBlankLines) {
  const TinyInstance instance = TinyInstance::parse(R"(# Two agents pass each other.
map
....
.@@.   # a ring would need one more row

agents
0,0 -> 3,1
3,0 -> -
tasks
2,0: 0 1
)");
  EXPECT_EQ(instance.rows, (std::vector<std::string>{"....", ".@@."}));
  ASSERT_EQ(instance.agents.size(), 2u);
  EXPECT_EQ(instance.agents[0].goal, (Position{3, 1}));
  EXPECT_FALSE(instance.agents[1].goal);
  ASSERT_EQ(instance.tasks.size(), 1u);
  EXPECT_EQ(instance.tasks[0].cell, (Position{2, 0}));
  EXPECT_EQ(instance.tasks[0].agents, (std::vector<int>{0, 1}));
  EXPECT_EQ(instance.build().agent_count(), 2);
}

TEST(TinyInstance, RefusesMalformedText) {
  for (const char* text :
       {"....\n", "map\n.x.\n", "map\n..\nagents\n0;0 -> 1,0\n", "map\n..\nagents\n0,0 => 1,0\n",
        "map\n..\nagents\n0,0 ->\n", "map\n..\nagents\n0,0 -> 1,0\ntasks\n1,0 0\n",
        "map\n..\nagents\n0,0 -> 1,0\ntasks\n1,0: 0 x\n", "map\n.. ..\n"})
    EXPECT_THROW(TinyInstance::parse(text), std::invalid_argument) << text;
  EXPECT_THROW(TinyInstance::parse("map\n...\n..\nagents\n0,0 -> 1,0\n").build(),
               std::invalid_argument);
}

TEST(RandomInstance, IsValidAndRoundTripsThroughText) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const TinyInstance instance = random_instance(seed);
    ASSERT_NO_THROW(instance.build()) << instance.to_text();
    ASSERT_EQ(TinyInstance::parse(instance.to_text()), instance) << instance.to_text();
  }
}

TEST(RandomWorld, IsValidAndRoundTripsThroughText) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const TinyInstance instance = random_world(seed);
    ASSERT_NO_THROW(instance.build()) << instance.to_text();
    ASSERT_EQ(TinyInstance::parse(instance.to_text()), instance) << instance.to_text();
  }
}

TEST(RandomInstance, IsTheSameForTheSameSeed) {
  EXPECT_EQ(random_instance(7), random_instance(7));
  EXPECT_NE(random_instance(7), random_instance(8));
}

// Features that are difficult for the search must occur often.
TEST(RandomInstance, CoversDifficultFeatures) {
  int mg = 0;
  int shared_tasks = 0;
  int tasks_on_destinations = 0;
  int tasks_on_starts = 0;
  std::set<std::size_t> agents;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const TinyInstance instance = random_instance(seed);
    agents.insert(instance.agents.size());
    for (const auto& agent : instance.agents) mg += !agent.goal;
    for (const auto& task : instance.tasks) {
      shared_tasks += task.agents.size() > 1;
      for (const auto& agent : instance.agents) {
        tasks_on_destinations += agent.goal == task.cell;
        tasks_on_starts += agent.start == task.cell;
      }
    }
  }
  EXPECT_EQ(agents, (std::set<std::size_t>{1, 2, 3, 4}));
  EXPECT_GT(mg, 200);
  EXPECT_GT(shared_tasks, 100);
  EXPECT_GT(tasks_on_destinations, 100);
  EXPECT_GT(tasks_on_starts, 100);
}

}  // namespace tiny_instance_test
}  // namespace grove::detail::fuzz
