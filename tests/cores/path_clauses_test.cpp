// SPDX-License-Identifier: MIT
// Compares the clauses of one agent with the low level.
#include "cores/path_clauses.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "planning/free_order_sipp.h"
#include "planning/problem.h"
#include "tests/fuzz/random.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace path_clauses_test {

constexpr Time kLevels = 4;

// A constraint on a place or a corridor of the world, at early times.
Constraint random_constraint(const World& world, const Corridors& corridors, fuzz::Random& random) {
  const auto any_place = [&] { return static_cast<Place>(random.below(world.place_count())); };
  const Time begin = random.below(8);
  Constraint c{.cell = any_place(), .begin = begin, .end = begin + random.pick<Time>({0, 0, 1, 5})};
  switch (random.below(corridors.count() > 0 ? 5 : 4)) {
    case 0:
      return c;
    case 1:
      if (const auto neighbors = world.neighbors(c.cell); !neighbors.empty())
        c.from =
            neighbors[static_cast<std::size_t>(random.below(static_cast<int>(neighbors.size())))];
      return c;
    case 2:
      return {.cell = c.cell, .end = c.end, .kind = ConstraintKind::kNoRestBy};
    case 3:
      return {.cell = c.cell, .end = c.end + 3, .kind = ConstraintKind::kRestBy};
    default: {
      const auto places = corridors.places(random.below(corridors.count()));
      c.kind = ConstraintKind::kNoTraversal;
      const bool at_back = random.percent(50);
      c.cell = at_back ? places.back() : places.front();
      c.from = at_back ? places[places.size() - 2] : places[1];
      c.end += 4;
      return c;
    }
  }
}

// The agent's least cost under constraints, if it has a path of at most `cutoff`.
std::optional<Time> least_cost(AgentStops& stops, const std::vector<Constraint>& constraints,
                               Time cutoff) {
  SequenceStages goals(stops, SequenceClass{});
  Path path;
  FreeOrderSipp low_level(stops.instance().world());
  const PathOutcome outcome = low_level.find(
      goals, PathQuery{.constraints = constraints, .cutoff = cutoff}, Limits(), path);
  if (outcome != PathOutcome::kFound) return std::nullopt;
  return static_cast<Time>(path.size()) - 1;
}

// Under random constraints there is a model within an excess exactly if the low level finds a path
// within it, and the walk of the model satisfies the constraints. Constraints are added before and
// after the clauses have grown.
TEST(PathClauses, AgreeWithTheLowLevel) {
  std::map<std::pair<ConstraintKind, bool>, int> seen;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(400));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = fuzz::any_instance(seed).build();
    const World& world = instance.world();
    const Limits limits;
    const Problem problem(instance, limits);
    fuzz::Random random(seed);
    const AgentIndex agent = random.below(instance.agent_count());
    AgentStops stops(instance, problem.distances, agent);
    const auto least = least_cost(stops, {}, kNever);
    if (!least) continue;
    PathGraph graph(stops, *least);
    SatSolver solver(limits);
    PlaceConflicts conflicts(solver);
    PathClauses clauses(solver, agent, graph, problem.corridors, conflicts);
    std::vector<Constraint> all;
    std::vector<Literal> literals;
    const auto add_constraint = [&] {
      all.push_back(random_constraint(world, problem.corridors, random));
      literals.push_back(clauses.satisfies(all.back()));
    };
    for (Time level = 0; level < kLevels; ++level) {
      const std::size_t visits = random.percent(50) ? 7 : 1'000'000;
      auto grown = PathGraph::Outcome::kGrowing;
      while (grown == PathGraph::Outcome::kGrowing)
        grown = graph.grow(level, visits, 1'000'000, limits);
      ASSERT_EQ(grown, PathGraph::Outcome::kGrown);
      if (random.percent(50)) add_constraint();
      while (!clauses.grow(random.percent(50) ? 5 : 1'000'000)) {
      }
      for (int i = 0; i < 3; ++i) add_constraint();
      for (int round = 0; round < 6; ++round) {
        std::vector<Constraint> some;
        std::vector<Literal> assumptions{clauses.within(level)};
        for (std::size_t i = 0; i < all.size(); ++i) {
          if (!random.percent(round < 2 ? 15 : 40)) continue;
          some.push_back(all[i]);
          assumptions.push_back(literals[i]);
        }
        const bool has_path = least_cost(stops, some, *least + level).has_value();
        const auto result = solver.solve(assumptions, 1'000'000);
        ASSERT_EQ(result,
                  has_path ? SatSolver::Result::kSatisfiable : SatSolver::Result::kUnsatisfiable);
        for (const Constraint& c : some) ++seen[{c.kind, has_path}];
        if (!has_path) continue;
        const auto walk = clauses.walk();
        ASSERT_TRUE(walk);
        Path path;
        for (const PathGraph::Node node : *walk) path.push_back(graph.state(node));
        ASSERT_LE(std::ssize(path) - 1, *least + level);
        for (const Constraint& c : some)
          ASSERT_TRUE(satisfies(world, path, c, problem.corridors)) << name_of(c.kind);
      }
    }
  }
  EXPECT_EQ(seen.size(), 8);
  for (const auto& [kind, count] : seen)
    EXPECT_GT(count, 100) << name_of(kind.first) << " " << kind.second;
}

}  // namespace path_clauses_test
}  // namespace grove::detail
