// SPDX-License-Identifier: MIT
// What a constraint asks of a path is written twice, in the library and in tests/support/satisfies:
// the two must agree.
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

TEST(Constraint, IsObeyedAsTheTestsSay) {
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
      const bool obeyed = satisfies(grid, path, c, corridors);
      ++seen[{c.kind, obeyed}];
      ASSERT_EQ(obeyed, testing::satisfies(grid, path, c))
          << name_of(c.kind) << " " << c.cell << " " << c.from << " " << c.begin << " " << c.end;
    }
  }
  for (const ConstraintKind kind : kOnPaths) {
    const int obeyed = seen[{kind, true}];
    const int broken = seen[{kind, false}];
    EXPECT_GT(obeyed, 100) << name_of(kind);
    EXPECT_GT(broken, 100) << name_of(kind);
  }
}

TEST(Constraint, OnTheSequenceIsNotObeyedByAPathAlone) {
  const Grid grid = testing::grid_of({".."});
  const Constraint next{1, kNoCell, 0, 0, ConstraintKind::kStopIs};
  EXPECT_TRUE(is_about_sequence(next));
  EXPECT_THROW(satisfies(grid, {0, 1}, next, Corridors(grid)), std::invalid_argument);
}

// Files and other processes know kinds by these numbers.
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

// Three agents; what each of them is asked, by either function.
TEST(Constraint, ConcernsItsAgentAndOfRestsTheOthersToo) {
  const std::array<AgentIndex, 3> all{0, 1, 2};
  const auto asked = [&](const AgentConstraint& added) {
    std::array<std::optional<Constraint>, 3> demands;
    for_each_implied_constraint(added, all,
                                [&](AgentIndex agent, const Constraint& c) { demands[agent] = c; });
    for (const AgentIndex agent : all) EXPECT_EQ(demands[agent], constraint_on(agent, added));
    return demands;
  };
  for (const ConstraintKind kind : kOnPaths) {
    const Constraint c{7, kNoCell, 0, 5, kind};
    const auto demands = asked({1, c});
    EXPECT_EQ(demands[1], c);
    EXPECT_EQ(demands[0].has_value(), kind == ConstraintKind::kRestBy);
    EXPECT_EQ(demands[2], demands[0]);
    if (demands[0]) {
      EXPECT_EQ(*demands[0], (Constraint{7, kNoCell, 5, kNever}));
    }
    for (const auto& demand : asked({-1, c})) EXPECT_FALSE(demand);
  }
}

}  // namespace constraint_test
}  // namespace grove::detail
