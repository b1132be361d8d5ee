// SPDX-License-Identifier: MIT
// Tests constraints and the paths that satisfy them. The library and tests/support/satisfies
// implement satisfies() independently and must agree.
#include "planning/constraint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "planning/corridors.h"
#include "tests/planning/random_cases.h"
#include "tests/planning/single_agent.h"
#include "tests/support/satisfies.h"

namespace grove::detail {
namespace constraint_test {

constexpr std::array kOnPaths{ConstraintKind::kVertexOrEdge, ConstraintKind::kNoRestBy,
                              ConstraintKind::kRestBy, ConstraintKind::kNoTraversal};

TEST(Constraint, SatisfiesAgreesWithReference) {
  std::mt19937 random(5);
  std::map<std::pair<ConstraintKind, bool>, int> seen;
  for (int round = 0; round < 300; ++round) {
    const Grid grid = testing::random_corridor_map(random);
    const Corridors corridors(grid);
    for (int i = 0; i < 40; ++i) {
      const Path path = testing::random_walk(grid, random, 15);
      const std::vector<Cell> goals{path[0], path.back()};
      const Constraint c = random() % 3 == 0
                               ? testing::random_bar(grid, path, goals, random)
                               : testing::random_conditional_constraint(grid, path, goals, random);
      const bool satisfied = satisfies(grid, path, c, corridors);
      ++seen[{c.kind, satisfied}];
      ASSERT_EQ(satisfied, testing::satisfies(grid, path, c))
          << name_of(c.kind) << " " << c.cell << " " << c.from << " " << c.begin << " " << c.end;
    }
  }
  for (const ConstraintKind kind : kOnPaths) {
    const int satisfied = seen[{kind, true}];
    const int violated = seen[{kind, false}];
    EXPECT_GT(satisfied, 100) << name_of(kind);
    EXPECT_GT(violated, 100) << name_of(kind);
  }
}

// Of the constraints that violates() decides, a path satisfies those that none of its presences
// violates.
TEST(Constraint, PresencesDecideConstraintsOnPlacesAndRests) {
  std::mt19937 random(6);
  std::map<std::pair<ConstraintKind, bool>, int> seen;
  for (int round = 0; round < 4000; ++round) {
    const Grid grid = testing::random_corridor_map(random);
    const Path path = testing::random_walk(grid, random, 15);
    const std::vector<Cell> goals{path[0], path.back()};
    const Constraint c = random() % 3 == 0
                             ? testing::random_bar(grid, path, goals, random)
                             : testing::random_conditional_constraint(grid, path, goals, random);
    if (c.is_move() || c.kind == ConstraintKind::kNoTraversal) continue;
    const Time last = last_arrival(grid, path);
    bool violated = violates(c, path.back(), last, true);
    for (Time time = 0; time < last; ++time) violated |= violates(c, path[time], time, false);
    ++seen[{c.kind, violated}];
    ASSERT_EQ(violated, !testing::satisfies(grid, path, c))
        << name_of(c.kind) << " " << c.cell << " " << c.begin << " " << c.end;
  }
  EXPECT_EQ(seen.size(), 6);
  for (const auto& [kind, count] : seen) EXPECT_GT(count, 20) << name_of(kind.first);
}

TEST(Constraint, SatisfiesThrowsForSequenceConstraint) {
  const Grid grid = testing::grid_of({".."});
  const Constraint next{1, kNoCell, 0, 0, ConstraintKind::kStopIs};
  EXPECT_TRUE(is_about_sequence(next));
  EXPECT_THROW(satisfies(grid, {0, 1}, next, Corridors(grid)), std::invalid_argument);
}

// The numbers are part of file formats and of messages between processes.
TEST(Constraint, KindsHaveNumbersAndNames) {
  const std::array names{"bar", "no-rest-by", "rest-by", "no-traversal", "stop-is", "stop-is-not"};
  for (std::uint8_t number = 0; number < names.size(); ++number) {
    const auto kind = constraint_kind(number);
    ASSERT_TRUE(kind);
    EXPECT_EQ(static_cast<std::uint8_t>(*kind), number);
    EXPECT_EQ(name_of(*kind), names[number]);
  }
  EXPECT_FALSE(constraint_kind(names.size()));
  EXPECT_FALSE(constraint_kind(255));
}

// For each of three agents, for_each_implied_constraint() and constraint_on() must return the same
// constraint.
TEST(Constraint, AppliesToItsAgentAndRestByToAllOthers) {
  const std::array<AgentIndex, 3> all{0, 1, 2};
  const auto implied_by = [&](const AgentConstraint& added) {
    std::array<std::optional<Constraint>, 3> implied;
    for_each_implied_constraint(added, all,
                                [&](AgentIndex agent, const Constraint& c) { implied[agent] = c; });
    for (const AgentIndex agent : all) EXPECT_EQ(implied[agent], constraint_on(agent, added));
    return implied;
  };
  for (const ConstraintKind kind : kOnPaths) {
    const Constraint c{7, kNoCell, 0, 5, kind};
    const auto implied = implied_by({1, c});
    EXPECT_EQ(implied[1], c);
    EXPECT_EQ(implied[0].has_value(), kind == ConstraintKind::kRestBy);
    EXPECT_EQ(implied[2], implied[0]);
    if (implied[0]) {
      EXPECT_EQ(*implied[0], (Constraint{7, kNoCell, 5, kNever}));
    }
    for (const auto& constraint : implied_by({-1, c})) EXPECT_FALSE(constraint);
  }
}

}  // namespace constraint_test
}  // namespace grove::detail
