// SPDX-License-Identifier: MIT
#include "search/brancher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/search/root_fixture.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace brancher_test {

using testing::AgentSpec;
using testing::RootFixture;

const Techniques kCardinal{Technique::kStrongBranching};

struct Branched : RootFixture {
  using RootFixture::RootFixture;

  Brancher::Outcome branch(Cost cutoff = kInfiniteCost,
                           std::span<const Split> fallback_splits = {}) {
    children.clear();
    return brancher.branch(view, cutoff, fallback_splits, limits, children);
  }
  // Returns the agents that the children constrain, in ascending order.
  std::vector<AgentIndex> constrained() const {
    std::vector<AgentIndex> agents;
    for (const NodePtr& child : children) agents.push_back(child->added().agent);
    std::ranges::sort(agents);
    return agents;
  }

  Brancher brancher{problem, options, planner, memory};
  std::int64_t splits(ConstraintKind kind) const {
    return brancher.splits()[static_cast<std::size_t>(kind)];
  }

  std::vector<NodePtr> children;
};

// Agents 0 and 1 cross on open ground at time 1, and each has a different path of the same length.
// Agents 2 and 3 cross at time 3, each in an aisle one cell wide, so one of them must wait.
const std::vector<std::string> kOpenAndAisles{"...@@@.@@@",  //
                                              "...@@@.@@@",  //
                                              "...@@@.@@@",  //
                                              "@@@.......",  //
                                              "@@@@@@.@@@",  //
                                              "@@@@@@.@@@"};
const std::vector<AgentSpec> kFour{{{0, 1}, Position{2, 2}},
                                   {{1, 0}, Position{0, 2}},
                                   {{3, 3}, Position{9, 3}},
                                   {{6, 0}, Position{6, 5}}};

TEST(Brancher, PrefersTheConflictThatRaisesBothBranches) {
  Branched s(kOpenAndAisles, kFour, {kCardinal, 0, true});
  ASSERT_GE(s.view.conflicts().size(), 1u);
  ASSERT_EQ(s.branch(), Brancher::Outcome::kBranched);
  EXPECT_EQ(s.constrained(), std::vector<AgentIndex>({2, 3}));
  for (const NodePtr& child : s.children) EXPECT_EQ(child->cost(), s.root->cost() + 1);
}

// A door. The agent that gives way loses three steps, the other agent none.
const std::vector<std::string> kDoor{"..@..", ".....", "..@.."};
const std::vector<AgentSpec> kHeadOn{{{0, 1}, Position{4, 1}}, {{4, 1}, Position{0, 1}}};

TEST(Brancher, PrunesBranchesThatReachTheCutoff) {
  Branched s(kDoor, kHeadOn, {kCardinal, 0, true});
  ASSERT_EQ(s.branch(s.root->cost() + 2), Brancher::Outcome::kBranched);
  EXPECT_EQ(s.children.size(), 2u);
  for (const NodePtr& child : s.children) EXPECT_EQ(child->cost(), s.root->cost() + 1);
  const ChildCosts& child_costs = s.brancher.child_costs();
  const std::int64_t asked = child_costs.asked();
  EXPECT_GT(asked, child_costs.known());
  s.view.enter(s.root, s.all);
  ASSERT_EQ(s.branch(s.root->cost() + 2), Brancher::Outcome::kBranched);
  EXPECT_EQ(child_costs.asked(), 2 * asked);
  EXPECT_GE(child_costs.known(), asked);  // all queries of the second call are cached
  for (const Cost cutoff : {s.root->cost() + 1, s.root->cost()}) {
    s.view.enter(s.root, s.all);
    ASSERT_EQ(s.branch(cutoff), Brancher::Outcome::kBranched);
    EXPECT_TRUE(s.children.empty());
  }
}

TEST(Brancher, StopsWithoutChildrenAtALimit) {
  Branched s(kDoor, kHeadOn, {kCardinal, 0, true});
  s.limits.set_deadline(testing::kPast);
  EXPECT_EQ(s.branch(), Brancher::Outcome::kStopped);
  EXPECT_TRUE(s.children.empty());
}

// Two agents that cross on open ground and can avoid each other at no extra cost.
const std::vector<std::string> kOpen{"...", "...", "..."};
const std::vector<AgentSpec> kCrossing{{{0, 0}, Position{2, 2}}, {{0, 2}, Position{2, 0}}};
const std::vector<std::vector<Position>> kCollide{{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}},
                                                  {{0, 2}, {0, 1}, {1, 1}, {1, 0}, {2, 0}}};

TEST(Brancher, BypassesAConflictInsteadOfSplitting) {
  Branched with(kOpen, kCrossing, {{Technique::kStrongBranching, Technique::kBypass}, 0, true});
  with.take(kCollide);
  ASSERT_FALSE(with.view.conflict_free());
  const std::vector<Path> before(with.view.paths().begin(), with.view.paths().end());
  EXPECT_EQ(with.branch(), Brancher::Outcome::kConflictFree);
  EXPECT_TRUE(with.children.empty());
  EXPECT_TRUE(with.view.conflict_free());
  EXPECT_EQ(with.view.cost_of(0) + with.view.cost_of(1), with.root->cost());
  EXPECT_TRUE(with.view.path(0) != before[0] || with.view.path(1) != before[1]);
  EXPECT_GE(with.brancher.bypasses(), 1);
  EXPECT_EQ(with.splits(ConstraintKind::kVertexOrEdge), 0);

  Branched without(kOpen, kCrossing, {kCardinal, 0, true});
  without.take(kCollide);
  EXPECT_EQ(without.branch(), Brancher::Outcome::kBranched);
  EXPECT_EQ(without.children.size(), 2u);
  EXPECT_EQ(without.brancher.bypasses(), 0);
  EXPECT_EQ(without.splits(ConstraintKind::kVertexOrEdge), 1);
}

// The children inherit the paths of the view, bypasses included, because they descend from
// node_with_current_paths().
TEST(Brancher, KeepsBypassesInTheChildren) {
  Branched s(kOpenAndAisles, kFour, {{Technique::kStrongBranching, Technique::kBypass}, 0, true});
  ASSERT_EQ(s.branch(), Brancher::Outcome::kBranched);
  for (const NodePtr& child : s.children) {
    std::vector<Path> paths;
    child->paths(s.problem, paths);
    for (const AgentIndex agent : s.all)
      if (agent != child->added().agent) {
        EXPECT_EQ(paths[agent], s.view.path(agent));
      }
    EXPECT_EQ(child->parent()->cost(), s.root->cost());
  }
}

// Agent 1 rests in the passage of agent 0 from time 1 on. In one branch of the split it comes to
// rest later; in the other branch it rests by then.
TEST(Brancher, SplitsTargetConflictsOnTheTimeOfRest) {
  Branched s({"......", "@@.@@@"}, {{{0, 0}, Position{5, 0}}, {{4, 0}, Position{3, 0}}},
             {{Technique::kTarget}, 0, true});
  ASSERT_EQ(s.branch(), Brancher::Outcome::kBranched);
  ASSERT_FALSE(s.children.empty());
  for (const NodePtr& child : s.children) {
    EXPECT_EQ(child->added().agent, 1);
    EXPECT_EQ(child->added().constraint.kind, ConstraintKind::kNoRestBy);
  }
  // The other branch blocks the only path of agent 0, so it has no child.
  EXPECT_EQ(s.children.size(), 1u);
  EXPECT_EQ(s.splits(ConstraintKind::kRestBy), 1);
}

TEST(Brancher, TakesAFallbackSplitOnlyForAgentsInConflict) {
  const auto later = [](AgentIndex agent, Cell goal, Time by) {
    return AgentConstraint{agent, {goal, kNoCell, 0, by, ConstraintKind::kNoRestBy}};
  };
  const Split ours{later(0, 8, 4), later(1, 2, 4)};
  Branched s(kOpen, kCrossing, {kCardinal, 0, true});
  s.take(kCollide);
  ASSERT_EQ(s.branch(kInfiniteCost, std::array<Split, 1>{ours}), Brancher::Outcome::kBranched);
  for (const NodePtr& child : s.children) {
    EXPECT_EQ(child->added().constraint.kind, ConstraintKind::kNoRestBy);
    EXPECT_GT(child->cost(), s.root->cost());
  }
  Branched apart({"...", "...", "...", "..."},
                 {kCrossing[0], kCrossing[1], {{0, 3}, Position{2, 3}}}, {kCardinal, 0, true});
  apart.take(kCollide);
  const Split others{later(0, 8, 4), later(2, 11, 2)};
  ASSERT_EQ(apart.branch(kInfiniteCost, std::array<Split, 1>{others}),
            Brancher::Outcome::kBranched);
  EXPECT_EQ(apart.constrained(), std::vector<AgentIndex>({0, 1}));
}

// Two conflicts at the same time. Only the seed decides which of them is split.
TEST(Brancher, BreaksTiesBySeed) {
  const std::vector<AgentSpec> twice{{{0, 0}, Position{2, 2}},
                                     {{0, 2}, Position{2, 0}},
                                     {{4, 0}, Position{6, 2}},
                                     {{4, 2}, Position{6, 0}}};
  const std::vector<std::string> rows{"...@...", "...@...", "...@..."};
  auto routes = kCollide;
  for (std::vector<Position> route : kCollide) {
    for (Position& at : route) at.x += 4;
    routes.push_back(route);
  }
  std::set<std::vector<AgentIndex>> seen;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    Branched s(rows, twice, {Techniques(), seed, true});
    Branched again(rows, twice, {Techniques(), seed, true});
    s.take(routes);
    again.take(routes);
    ASSERT_EQ(s.branch(), Brancher::Outcome::kBranched);
    ASSERT_EQ(again.branch(), Brancher::Outcome::kBranched);
    EXPECT_EQ(s.constrained(), again.constrained());
    seen.insert(s.constrained());
  }
  EXPECT_EQ(seen, (std::set<std::vector<AgentIndex>>{{0, 1}, {2, 3}}));
}

// A search for a pair of agents examines only this pair and does not load other agents.
TEST(NodeView, LoadsOnlyTheAgentsOfItsScope) {
  RootFixture s(kOpenAndAisles, kFour);
  const std::array<AgentIndex, 2> pair{2, 3};
  s.view.enter(s.root, pair);
  ASSERT_FALSE(s.view.conflict_free());
  for (const Conflict& c : s.view.conflicts()) {
    EXPECT_EQ(c.first, 2);
    EXPECT_EQ(c.second, 3);
  }
  EXPECT_TRUE(s.view.path(0).empty());
  EXPECT_TRUE(s.view.conflict_between(3, 2));
  EXPECT_EQ(s.view.node_with_current_paths(), s.root);
}

TEST(NodeView, ListsTheAgentsAffectedByAConstraint) {
  RootFixture s({"....", "...."}, {{{0, 0}, Position{3, 0}}, {{0, 1}, Position{3, 1}}});
  std::vector<AgentIndex> agents;
  const auto affected_agents = [&](AgentIndex agent, const Constraint& c) {
    s.view.affected_agents({agent, c}, agents);
    return agents;
  };
  const Cell on_first = s.view.path(0)[1];
  EXPECT_EQ(affected_agents(0, {on_first, kNoCell, 1, 1}), std::vector<AgentIndex>({0}));
  EXPECT_EQ(affected_agents(0, {on_first, kNoCell, 2, 2}), std::vector<AgentIndex>());
  // Agent 0 rests on its goal by time 3, and agent 1 does not enter that cell, so no agent is
  // affected.
  EXPECT_EQ(affected_agents(0, {3, kNoCell, 0, 3, ConstraintKind::kRestBy}),
            std::vector<AgentIndex>());
  // If agent 0 had to rest on a cell of agent 1's path, both agents would be affected.
  EXPECT_EQ(affected_agents(0, {5, kNoCell, 0, 1, ConstraintKind::kRestBy}),
            std::vector<AgentIndex>({0, 1}));
}

}  // namespace brancher_test
}  // namespace grove::detail
