// SPDX-License-Identifier: MIT
// Tests target and corridor splits. Each collision-free pair of paths must satisfy a branch of the
// split, and the colliding pair must violate both branches.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "conflicts/symmetry_reasoning.h"
#include "tests/support/instances.h"
#include "tests/support/satisfies.h"

namespace grove::detail {
namespace splits_test {

using testing::satisfies;

// A random walk that rarely turns back and therefore passes through corridors.
Path random_walk(const Grid& grid, std::mt19937& random) {
  Path path;
  do path = {static_cast<Cell>(random() % grid.cell_count())};
  while (!grid.passable(path[0]));
  Cell before = kNoCell;
  for (auto steps = random() % 14; steps > 0; --steps) {
    const auto neighbors = grid.neighbors(path.back());
    Cell next = path.back();
    if (!neighbors.empty() && random() % 6 > 0) next = neighbors[random() % neighbors.size()];
    if (next == before && random() % 4 > 0) next = neighbors[random() % neighbors.size()];
    before = path.back();
    path.push_back(next);
  }
  while (path.size() > 1 && path.back() == path[path.size() - 2]) path.pop_back();
  return path;
}

// Returns whether both paths satisfy the constraints of one branch of the split.
bool satisfies_branch(const Grid& grid, const AgentConstraint& branch,
                      const std::array<Path, 2>& paths) {
  for (AgentIndex agent : {0, 1})
    if (const auto constraint = constraint_on(agent, branch))
      if (!satisfies(grid, paths[agent], *constraint)) return false;
  return true;
}

class SplitsTest : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(SplitsTest, KeepCollisionFreePairsAndExcludeCollision) {
  const Instance instance = testing::instance_of(GetParam(), {{{0, 0}, Position{0, 0}}});
  const Grid& grid = instance.grid();
  const Corridors corridors(grid);
  ConflictFinder finder(grid);
  std::mt19937 random(17);
  std::vector<std::array<Path, 2>> pairs(3000);
  for (auto& pair : pairs)
    for (Path& path : pair) path = random_walk(grid, random);

  constexpr std::array<AgentIndex, 2> kBoth{0, 1};
  std::vector<std::array<Path, 2>> collision_free;
  std::vector<Split> splits;
  std::vector<Conflict> conflicts;
  int by_target = 0;
  int by_corridor = 0;
  for (const auto& pair : pairs) {
    finder.all(pair, kBoth, conflicts);
    if (conflicts.empty()) collision_free.push_back(pair);
    for (const Conflict& conflict : conflicts)
      for (const auto& split : {target_split(conflict, pair, grid, corridors),
                                corridor_split(conflict, pair, grid, corridors)})
        if (split) {
          const bool target = (*split)[0].constraint.kind == ConstraintKind::kNoRestBy;
          ++(target ? by_target : by_corridor);
          for (const AgentConstraint& branch : *split)
            EXPECT_FALSE(satisfies_branch(grid, branch, pair));
          splits.push_back(*split);
        }
  }
  for (std::size_t i = 0; i < splits.size(); i += 1 + splits.size() / 400)
    for (const auto& pair : collision_free)
      EXPECT_TRUE(satisfies_branch(grid, splits[i][0], pair) ||
                  satisfies_branch(grid, splits[i][1], pair));
  EXPECT_GT(collision_free.size(), 500u);
  EXPECT_GT(by_target, 100);
  EXPECT_GT(by_corridor, 20);
}

INSTANTIATE_TEST_SUITE_P(Maps, SplitsTest,
                         ::testing::Values(std::vector<std::string>{"..@..", ".....", "..@.."},
                                           std::vector<std::string>{"..@@@..", ".......",
                                                                    "..@@@.."},
                                           std::vector<std::string>{"...@@", ".@...", "...@@"},
                                           std::vector<std::string>{".....", "@@.@@", "....."}));

}  // namespace splits_test
}  // namespace grove::detail
