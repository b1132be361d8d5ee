// SPDX-License-Identifier: MIT
#include "grove/conflicts/conflict.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/obeys.h"

namespace grove {
namespace {

using testing::obeys;

Grid open_grid(int width, int height) {
  return Grid(width, height, std::vector<bool>(static_cast<std::size_t>(width) * height, true));
}

Cell at(const Path& path, Time t) {
  return path[std::min<std::size_t>(static_cast<std::size_t>(t), path.size() - 1)];
}

// Do agents a and b collide at time t? Straight from the definition.
bool collide(const Path& a, const Path& b, Time t) {
  if (at(a, t) == at(b, t)) return true;
  return t > 0 && at(a, t) == at(b, t - 1) && at(b, t) == at(a, t - 1);
}

std::optional<Time> first_collision(const std::vector<Path>& paths) {
  for (Time t = 0; t < 50; ++t)
    for (std::size_t a = 0; a < paths.size(); ++a)
      for (std::size_t b = a + 1; b < paths.size(); ++b)
        if (collide(paths[a], paths[b], t)) return t;
  return std::nullopt;
}

TEST(ConflictFinder, SeesVertexConflicts) {
  const Grid grid = open_grid(3, 1);
  ConflictFinder finder(grid, 0);
  const auto conflict = finder.first(std::vector<Path>{{0, 1, 2}, {2, 1, 0}});
  ASSERT_TRUE(conflict);
  EXPECT_FALSE(conflict->is_swap());
  EXPECT_EQ(conflict->cell, 1);
  EXPECT_EQ(conflict->time, 1);
}

TEST(ConflictFinder, SeesSwaps) {
  const Grid grid = open_grid(4, 1);
  ConflictFinder finder(grid, 0);
  const auto conflict = finder.first(std::vector<Path>{{0, 1, 2}, {3, 2, 1}});
  ASSERT_TRUE(conflict);
  EXPECT_TRUE(conflict->is_swap());
  EXPECT_EQ(conflict->time, 2);
  EXPECT_EQ(conflict->from, 1);
  EXPECT_EQ(conflict->cell, 2);
}

TEST(ConflictFinder, SeesAgentsThatRestInTheWay) {
  const Grid grid = open_grid(4, 1);
  ConflictFinder finder(grid, 0);
  const auto conflict = finder.first(std::vector<Path>{{2}, {0, 1, 2, 3}});
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->time, 2);
}

TEST(ConflictFinder, AllowsFollowingAndRotation) {
  const Grid grid = open_grid(2, 2);
  ConflictFinder finder(grid, 0);
  EXPECT_FALSE(finder.first(std::vector<Path>{{0, 1}, {1, 3}, {3, 2}, {2, 0}}));
}

TEST(ConflictFinder, FindsTheFirstCollisionOfRandomPathsAndSplitLosesNone) {
  const Grid grid = open_grid(5, 4);
  std::mt19937 random(7);
  ConflictFinder finder(grid, 3);
  int with_conflict = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<Path> paths(2 + random() % 3);
    for (Path& path : paths) {
      path.push_back(static_cast<Cell>(random() % 20));
      const auto steps = random() % 8;
      for (std::size_t s = 0; s < steps; ++s) {
        const auto neighbors = grid.neighbors(path.back());
        const auto pick = random() % (neighbors.size() + 1);
        path.push_back(pick < neighbors.size() ? neighbors[pick] : path.back());
      }
    }
    const auto expected = first_collision(paths);
    const auto conflict = finder.first(paths);
    ASSERT_EQ(conflict.has_value(), expected.has_value());
    if (!conflict) continue;
    ++with_conflict;
    EXPECT_EQ(conflict->time, *expected);
    EXPECT_TRUE(collide(paths[conflict->first], paths[conflict->second], conflict->time));
    // Both colliding paths break their constraint: each child must replan.
    for (const AgentConstraint& branch : split(*conflict))
      EXPECT_FALSE(obeys(grid, paths[branch.agent], branch.constraint));
    // Any two paths that do not collide there obey at least one of the two.
    const auto branches = split(*conflict);
    for (const Path& a : paths)
      for (const Path& b : paths)
        EXPECT_TRUE(collide(a, b, conflict->time) || obeys(grid, a, branches[0].constraint) ||
                    obeys(grid, b, branches[1].constraint));
  }
  EXPECT_GT(with_conflict, 500);
}

}  // namespace
}  // namespace grove
