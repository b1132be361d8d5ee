// SPDX-License-Identifier: MIT
#include "conflicts/conflict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "tests/support/satisfies.h"

namespace grove::detail {
namespace conflict_test {

using testing::satisfies;

Grid open_grid(int width, int height) {
  return Grid(width, height, std::vector<bool>(static_cast<std::size_t>(width) * height, true));
}

Cell at(const Path& path, Time t) {
  return path[std::min<std::size_t>(static_cast<std::size_t>(t), path.size() - 1)];
}

// Returns whether agents a and b collide at time t, by the definition.
bool collide(const Path& a, const Path& b, Time t, bool may_follow = true) {
  if (at(a, t) == at(b, t)) return true;
  const auto enters = [&](const Path& one, const Path& other) {
    return t > 0 && at(one, t) != at(one, t - 1) && at(one, t) == at(other, t - 1);
  };
  if (!may_follow && (enters(a, b) || enters(b, a))) return true;
  return t > 0 && at(a, t) == at(b, t - 1) && at(b, t) == at(a, t - 1);
}

// Collisions of pairs of agents, each as the time and the two agents. Times at which both agents
// wait do not count.
using Collisions = std::multiset<std::tuple<Time, AgentIndex, AgentIndex>>;

Collisions collisions(const std::vector<Path>& paths, const std::vector<AgentIndex>& agents,
                      bool may_follow) {
  Collisions all;
  for (Time t = 0; t < 50; ++t)
    for (AgentIndex a : agents)
      for (AgentIndex b : agents)
        if (a < b && collide(paths[a], paths[b], t, may_follow) &&
            !(t > 0 && at(paths[a], t - 1) == at(paths[a], t) &&
              at(paths[b], t - 1) == at(paths[b], t)))
          all.emplace(t, a, b);
  return all;
}

std::vector<Conflict> conflicts_of(ConflictFinder& finder, const std::vector<Path>& paths) {
  std::vector<AgentIndex> all(paths.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Conflict> conflicts;
  finder.all(paths, all, conflicts);
  return conflicts;
}

TEST(ConflictFinder, FindsVertexConflicts) {
  const Grid grid = open_grid(3, 1);
  ConflictFinder finder(grid);
  const auto conflicts = conflicts_of(finder, std::vector<Path>{{0, 1, 2}, {2, 1, 0}});
  ASSERT_EQ(conflicts.size(), 1u);
  const Conflict* conflict = conflicts.data();
  EXPECT_FALSE(conflict->is_swap());
  EXPECT_EQ(conflict->cell, 1);
  EXPECT_EQ(conflict->time, 1);
}

TEST(ConflictFinder, FindsSwaps) {
  const Grid grid = open_grid(4, 1);
  ConflictFinder finder(grid);
  const auto conflicts = conflicts_of(finder, std::vector<Path>{{0, 1, 2}, {3, 2, 1}});
  ASSERT_EQ(conflicts.size(), 1u);
  const Conflict* conflict = conflicts.data();
  EXPECT_TRUE(conflict->is_swap());
  EXPECT_EQ(conflict->time, 2);
  EXPECT_EQ(conflict->from, 1);
  EXPECT_EQ(conflict->cell, 2);
}

TEST(ConflictFinder, FindsConflictsWithRestingAgents) {
  const Grid grid = open_grid(4, 1);
  ConflictFinder finder(grid);
  const auto conflicts = conflicts_of(finder, std::vector<Path>{{2}, {0, 1, 2, 3}});
  ASSERT_EQ(conflicts.size(), 1u);
  const Conflict* conflict = conflicts.data();
  EXPECT_EQ(conflict->time, 2);
}

TEST(ConflictFinder, AllowsFollowingAndRotation) {
  const Grid grid = open_grid(2, 2);
  ConflictFinder finder(grid);
  EXPECT_TRUE(conflicts_of(finder, std::vector<Path>{{0, 1}, {1, 3}, {3, 2}, {2, 0}}).empty());
}

TEST(ConflictFinder, FindsFollowingConflictsIfForbidden) {
  const Grid grid = open_grid(4, 1);
  ConflictFinder finder(grid, false);
  const auto conflicts = conflicts_of(finder, std::vector<Path>{{1, 2, 3}, {0, 0, 1, 2}, {0}});
  // Agent 1 does not follow agent 0: it enters cell 1 at time 2, after agent 0 left it at time 1,
  // and enters cell 2 at time 3, when agent 0 has already left it, too.
  std::vector<Conflict> following;
  for (const Conflict& c : conflicts)
    if (c.is_following()) following.push_back(c);
  EXPECT_TRUE(following.empty());
  const auto close = conflicts_of(finder, std::vector<Path>{{1, 2, 3}, {0, 1, 2}});
  ASSERT_EQ(close.size(), 2u);
  EXPECT_EQ(close[0].follower, 1);
  EXPECT_EQ(close[0].cell, 1);
  EXPECT_EQ(close[0].time, 1);
  EXPECT_EQ(split(close[0])[0].constraint.begin, 0);
  EXPECT_EQ(split(close[0])[1].constraint.begin, 1);
  const Grid square = open_grid(2, 2);
  ConflictFinder ring(square, false);
  EXPECT_EQ(conflicts_of(ring, std::vector<Path>{{0, 1}, {1, 3}, {3, 2}, {2, 0}}).size(), 4u);
}

class RandomPaths : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(MayFollow, RandomPaths, ::testing::Bool());

TEST_P(RandomPaths, CollisionsAreFoundAndSplitsAreComplete) {
  const Grid grid = open_grid(5, 4);
  std::mt19937 random(7);
  ConflictFinder finder(grid, GetParam());
  int with_conflict = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<Path> paths(2 + random() % 4);
    std::vector<AgentIndex> agents;
    for (Path& path : paths) {
      path.push_back(static_cast<Cell>(random() % 20));
      const auto steps = random() % 8;
      for (std::size_t s = 0; s < steps; ++s) {
        const auto neighbors = grid.neighbors(path.back());
        const auto pick = random() % (neighbors.size() + 1);
        path.push_back(pick < neighbors.size() ? neighbors[pick] : path.back());
      }
      if (random() % 4 > 0) agents.push_back(static_cast<AgentIndex>(&path - paths.data()));
    }
    std::vector<Conflict> conflicts;
    finder.all(paths, agents, conflicts);
    Collisions found;
    for (const Conflict& c : conflicts) found.emplace(c.time, c.first, c.second);
    ASSERT_EQ(found, collisions(paths, agents, GetParam()));
    ASSERT_TRUE(std::ranges::is_sorted(conflicts, {}, &Conflict::time));
    for (const Conflict& conflict : conflicts) {
      ++with_conflict;
      // Each colliding path violates the constraint of its branch, so each child must re-plan.
      const Split branches = split(conflict);
      for (const AgentConstraint& branch : branches)
        EXPECT_FALSE(satisfies(grid, paths[branch.agent], branch.constraint));
      // Any two paths without this collision satisfy at least one of the two constraints.
      for (const Path& a : paths)
        for (const Path& b : paths)
          EXPECT_TRUE(collide(a, b, conflict.time, GetParam()) ||
                      (conflict.is_following() && collide(a, b, conflict.time - 1)) ||
                      satisfies(grid, a, branches[0].constraint) ||
                      satisfies(grid, b, branches[1].constraint));
    }
  }
  EXPECT_GT(with_conflict, 500);
}

}  // namespace conflict_test
}  // namespace grove::detail
