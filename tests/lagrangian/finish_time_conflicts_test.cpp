// SPDX-License-Identifier: MIT
#include "lagrangian/finish_time_conflicts.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/lagrangian/tiny_agents.h"

namespace grove::detail::lagrangian_test {
namespace {

using Node = AgentGraph::Node;

// Returns whether both agents can be at rest by these times without any collision. Uses
// breadth-first search over joint states.
bool can_both_finish(const AgentGraph& a, const AgentGraph& b, Time by_a, Time by_b) {
  if (a.place(0) == b.place(0)) return false;
  using Pairs = std::vector<std::pair<Node, Node>>;
  Pairs now{{AgentGraph::start(), AgentGraph::start()}};
  std::vector<Time> seen(a.count() * b.count(), -1);
  // Runs one step beyond the later finish, because coming to rest is a move although it takes no
  // time.
  for (Time time = 0; time <= std::max(by_a, by_b) + 1; ++time) {
    Pairs next;
    for (const auto& [from_a, from_b] : now)
      for (const auto& move_a : a.moves(from_a))
        for (const auto& move_b : b.moves(from_b)) {
          // An agent that comes to rest in the step from t to t + 1 has finish time t.
          if (!a.rests(move_a.to) && time + 1 > by_a) continue;
          if (!b.rests(move_b.to) && time + 1 > by_b) continue;
          const Place to_a = a.place(move_a.to);
          const Place to_b = b.place(move_b.to);
          if (to_a == to_b) continue;
          if (to_a == b.place(from_b) && to_b == a.place(from_a)) continue;
          if (a.rests(move_a.to) && b.rests(move_b.to)) return true;
          Time& last = seen[move_a.to * b.count() + move_b.to];
          if (std::exchange(last, time) != time) next.emplace_back(move_a.to, move_b.to);
        }
    now = std::move(next);
  }
  return false;
}

// With limits that are never reached, exactly the pairs that cannot both finish are found
// incompatible.
TEST(FinishTimeConflicts, AgreeWithJointBreadthFirstSearch) {
  int excluded = 0, others = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    TinyProblem known(tiny_instance(seed));
    if (known.instance.agent_count() < 2) continue;
    const auto a = AgentGraph::make(known.instance, 0);
    const auto b = AgentGraph::make(known.instance, 1);
    if (!a || !b || a->count() == 0 || b->count() == 0) continue;
    FinishTimeConflicts pairs(known.instance.world(), known.stops,
                              {.mdd_nodes = 1 << 20, .joint_mdd_nodes = 1 << 20, .bytes = 1 << 28});
    const Time min_a = a->to_go(AgentGraph::start());
    const Time min_b = b->to_go(AgentGraph::start());
    for (Time by_a = min_a; by_a < min_a + 4; ++by_a)
      for (Time by_b = min_b; by_b < min_b + 4; ++by_b) {
        const bool incompatible = pairs.are_incompatible({0, 1, by_a, by_b}, {});
        ASSERT_EQ(incompatible, !can_both_finish(*a, *b, by_a, by_b)) << by_a << " " << by_b;
        ++(incompatible ? excluded : others);
        if (!incompatible) continue;
        const FinishTimePair later = pairs.extended({0, 1, by_a, by_b}, {});
        ASSERT_FALSE(can_both_finish(*a, *b, later.finish_a, later.finish_b));
      }
  }
  EXPECT_GT(excluded, 100);
  EXPECT_GT(others, 200);
}

// A pair that is found incompatible with sufficient limits is not found incompatible if one of the
// limits is 0. An MDD above its size limit or a joint search that was cut short proves nothing.
TEST(FinishTimeConflicts, ProveNothingWithoutEffort) {
  constexpr FinishTimeConflicts::MaxSizes kEnough{1 << 20, 1 << 20, 1 << 28};
  int excluded = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    TinyProblem known(tiny_instance(seed));
    if (known.instance.agent_count() < 2) continue;
    const auto finds_incompatible = [&](FinishTimeConflicts::MaxSizes most,
                                        const FinishTimePair& pair) {
      return FinishTimeConflicts(known.instance.world(), known.stops, most)
          .are_incompatible(pair, {});
    };
    const auto a = AgentGraph::make(known.instance, 0);
    const auto b = AgentGraph::make(known.instance, 1);
    if (!a || !b || a->count() == 0 || b->count() == 0) continue;
    // Each agent has a path that finishes at its time in the pair.
    const FinishTimePair pair{0, 1, a->to_go(AgentGraph::start()), b->to_go(AgentGraph::start())};
    if (!finds_incompatible(kEnough, pair)) continue;
    ++excluded;
    EXPECT_FALSE(finds_incompatible({0, kEnough.joint_mdd_nodes, kEnough.bytes}, pair));
    EXPECT_FALSE(finds_incompatible({kEnough.mdd_nodes, 0, kEnough.bytes}, pair));
    EXPECT_FALSE(finds_incompatible({kEnough.mdd_nodes, kEnough.joint_mdd_nodes, 0}, pair));
  }
  EXPECT_GT(excluded, 10) << "no incompatible pair was tested";
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
