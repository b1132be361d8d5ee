// SPDX-License-Identifier: MIT
#include "primal/pibt_generator.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "crowd.h"
#include "primal/visit_orders.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace pibt_generator_test {

using testing::instance_of;

struct Agents {
  explicit Agents(const Instance& the_instance)
      : instance(the_instance), problem(instance, Limits()) {
    const auto orders = *cheapest_orders(problem, Limits());
    for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
      states.emplace_back(problem, i, orders[i]);
      places.push_back({instance.agent(i).start, states.back().first()});
      priority.push_back(i);
    }
  }

  const Instance& instance;
  Problem problem;
  std::vector<VisitStages> states;
  std::vector<AgentState> places;
  std::vector<AgentIndex> priority;
};

void expect_step(const Grid& grid, std::span<const AgentState> from, std::span<const State> to) {
  ASSERT_EQ(from.size(), to.size());
  for (std::size_t i = 0; i < to.size(); ++i) {
    const auto near = grid.neighbors(from[i].state);
    EXPECT_TRUE(to[i] == from[i].state || std::ranges::count(near, to[i]) == 1);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(to[i], to[j]);
      EXPECT_FALSE(to[i] == from[j].state && to[j] == from[i].state);
    }
  }
}

TEST(PibtGenerator, StepsNeverCollideAndSatisfyTheConstraints) {
  int satisfied = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Instance instance = testing::random_crowd({.agents = 60, .tasks = 40}, seed);
    Agents agents(instance);
    PibtGenerator generator(instance.grid(), agents.states);
    fuzz::Random random(seed);
    SplitMix64 generator_random(seed);
    for (int step = 0; step < 50; ++step) {
      random.shuffle(agents.priority);
      std::vector<LacamConstraint> orders;
      for (int i = random.below(4); i-- > 0;) {
        const Cell here = agents.places[agents.priority[i]].state;
        const auto near = instance.grid().neighbors(here);
        const int choice = random.below(static_cast<int>(near.size()) + 1);
        orders.push_back({agents.priority[i], choice == 0 ? here : near[choice - 1]});
      }
      const auto to = generator.step(agents.places, agents.priority, orders, generator_random);
      ASSERT_TRUE(!to.empty() || !orders.empty());
      if (to.empty()) continue;
      expect_step(instance.grid(), agents.places, to);
      for (const LacamConstraint& order : orders) EXPECT_EQ(to[order.agent], order.state);
      satisfied += orders.size() > 1;
      for (std::size_t i = 0; i < to.size(); ++i)
        agents.places[i] = {to[i], agents.states[i].after(agents.places[i].stage, to[i])};
    }
  }
  EXPECT_GT(satisfied, 50);
}

TEST(PibtGenerator, ReturnsNothingIfConstraintsAreImpossible) {
  const Instance instance =
      instance_of({"..."}, {{{0, 0}, Position{0, 0}}, {{1, 0}, Position{1, 0}}});
  Agents agents(instance);
  PibtGenerator generator(instance.grid(), agents.states);
  SplitMix64 generator_random(0);
  const auto fails = [&](std::vector<LacamConstraint> orders) {
    return generator.step(agents.places, agents.priority, orders, generator_random).empty();
  };
  EXPECT_TRUE(fails({{0, 1}, {1, 1}}));   // two agents on one cell
  EXPECT_TRUE(fails({{0, 1}, {1, 0}}));   // they swap cells
  EXPECT_TRUE(fails({{1, 0}}));           // the other agent cannot leave
  EXPECT_FALSE(fails({{0, 1}, {1, 2}}));  // they follow each other
}

TEST(PibtGenerator, AgentOfHigherPriorityPushesTheOther) {
  const Instance instance =
      instance_of({"...", "@.@"}, {{{0, 0}, Position{2, 0}}, {{1, 0}, Position{1, 0}}});
  Agents agents(instance);
  PibtGenerator generator(instance.grid(), agents.states);
  SplitMix64 generator_random(0);
  const auto to = generator.step(agents.places, agents.priority, {}, generator_random);
  ASSERT_FALSE(to.empty());
  EXPECT_EQ(to[0], 1);
  EXPECT_NE(to[1], 1);
}

TEST(PibtGenerator, BacksOffToTheJunctionWhereTwoMustPass) {
  // a0 and a1 face each other in the corridor, and the only bay is behind a0.
  const Instance instance =
      instance_of({".......", "@.@@@@@"}, {{{2, 0}, Position{6, 0}}, {{3, 0}, Position{0, 0}}});
  Agents agents(instance);
  PibtGenerator generator(instance.grid(), agents.states);
  SplitMix64 generator_random(0);
  const auto to = generator.step(agents.places, agents.priority, {}, generator_random);
  ASSERT_FALSE(to.empty());
  EXPECT_EQ(to[0], 1);
  EXPECT_EQ(to[1], 2);
}

}  // namespace pibt_generator_test
}  // namespace grove::detail
