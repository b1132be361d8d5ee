// SPDX-License-Identifier: MIT
// The low level against a search that looks at every time step. GROVE_FUZZ_FACTOR multiplies the
// number of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "grove/planning/low_level_search.h"
#include "tests/planning/random_constraint.h"
#include "tests/planning/reference_search.h"
#include "tests/planning/single_agent.h"
#include "tests/support/fuzz_factor.h"

namespace grove {
namespace low_level_fuzz_test {

using testing::grid_of;
using testing::NaiveConflicts;
using testing::path_error;
using testing::Problem;
using testing::reference_conflicts;
using testing::reference_cost;
using testing::SingleAgent;

// Random problems on tiny maps, each made harder one constraint at a time.
class Fuzzer {
 public:
  // `conditional`: constraints of all kinds, not bars alone.
  Fuzzer(unsigned seed, bool conditional) : random_(seed), conditional_(conditional) {}

  void run() {
    const Grid grid = random_grid();
    LowLevelSearch search(grid);
    for (int i = 0; i < 4; ++i) run_agent(grid, search);
  }

  int delayed = 0;
  int infeasible = 0;

 private:
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  Grid random_grid() {
    if (conditional_ && below(3) > 0) return testing::random_corridor_map(random_);
    switch (below(6)) {
      case 0:
        return grid_of({"......"});  // a corridor
      case 1:
        return grid_of({"@.@", "...", "@.@", "@.@"});  // dead ends
      case 2:
        return grid_of({"..@..", ".....", "..@.."});  // a door
      case 3:
        return grid_of({"....", ".@@.", "...."});  // a ring
      default:
        break;
    }
    const int width = 1 + below(4);
    const int height = 1 + below(4);
    std::vector<bool> passable(width * height);
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(5) > 0;
    passable[0] = true;
    return Grid(width, height, passable);
  }

  Cell random_cell(const Grid& grid) {
    for (;;)
      if (const Cell cell = below(grid.cell_count()); grid.passable(cell)) return cell;
  }

  void run_agent(const Grid& grid, LowLevelSearch& search) {
    std::vector<Cell> tasks;
    for (int n = below(5); n > 0; --n)
      if (const Cell cell = random_cell(grid); std::ranges::count(tasks, cell) == 0)
        tasks.push_back(cell);
    std::optional<Cell> destination;
    if (tasks.empty() || below(3) > 0)
      destination = !tasks.empty() && below(4) == 0 ? tasks.back() : random_cell(grid);
    const SingleAgent agent(grid, random_cell(grid), tasks, destination);
    Problem problem{&grid, agent.goals.start(), tasks, {}};
    if (destination) problem.goals.push_back(*destination);
    make_harder(problem, agent, search);
  }

  void make_harder(Problem& problem, const SingleAgent& agent, LowLevelSearch& search) {
    NaiveConflicts others;
    ConflictAvoidanceTable table(*problem.grid);
    for (int n = below(4); n > 0; --n) {
      others.paths.push_back(random_walk(*problem.grid));
      table.add(others.paths.back());
    }
    Path path;
    for (int n = below(16); n >= 0; --n) {
      const bool found = check(problem, agent, search, table, others, path);
      if (::testing::Test::HasFatalFailure()) return;
      if (!found) {
        ++infeasible;
        return;
      }
      problem.constraints.push_back(random_constraint(problem, path));
      std::ranges::shuffle(problem.constraints, random_);
    }
  }

  Path random_walk(const Grid& grid) {
    Path path{random_cell(grid)};
    for (int n = below(12); n > 0; --n) {
      const auto neighbors = grid.neighbors(path.back());
      const int choice = below(static_cast<int>(neighbors.size()) + 1);
      path.push_back(choice == 0 ? path.back() : neighbors[choice - 1]);
    }
    return path;
  }

  // Often on the path, often on a goal.
  Constraint random_constraint(const Problem& problem, const Path& path) {
    if (conditional_ && below(2) == 0)
      return testing::random_conditional_constraint(*problem.grid, path, problem.goals, random_);
    Constraint c;
    const int at = below(static_cast<int>(path.size()));
    c.cell = path[at];
    c.begin = at;
    if (below(2) == 0) {
      c.cell = below(4) == 0 ? random_cell(*problem.grid)
                             : problem.goals[below(static_cast<int>(problem.goals.size()))];
      c.begin = below(static_cast<int>(path.size()) + 6);
    }
    c.end = c.begin + (below(2) == 0 ? 0 : below(10));
    if (c.begin > 0 && below(12) == 0) c.end = kNever;
    if (below(3) == 0) {
      const auto neighbors = problem.grid->neighbors(c.cell);
      if (at > 0 && path[at - 1] != c.cell && c.cell == path[at])
        c.from = path[at - 1];
      else if (!neighbors.empty())
        c.from = neighbors[below(static_cast<int>(neighbors.size()))];
    }
    return c;
  }

  bool check(const Problem& problem, const SingleAgent& agent, LowLevelSearch& search,
             const ConflictAvoidanceTable& table, const NaiveConflicts& others, Path& path) {
    const std::optional<Time> expected = reference_cost(problem);
    check_once(problem, agent, search, nullptr, expected, path);
    check_once(problem, agent, search, &table, expected, path);
    if (!expected || ::testing::Test::HasFatalFailure()) return false;
    if (*expected > agent.goals.distance(agent.goals.start(), 0))
      ++delayed;
    else  // the promise of the essay: no delay, then the fewest conflicts possible
      EXPECT_EQ(others.conflicts(path), reference_conflicts(problem, others, *expected));
    return true;
  }

  void check_once(const Problem& problem, const SingleAgent& agent, LowLevelSearch& search,
                  const ConflictAvoidanceTable* table, std::optional<Time> expected, Path& path) {
    PathQuery query{problem.constraints, table};
    const auto find = [&](Path& found) { return search.find(agent.goals, query, Limits(), found); };
    const PathOutcome outcome = find(path);
    ASSERT_EQ(outcome, expected ? PathOutcome::kFound : PathOutcome::kInfeasible);
    if (!expected) return;
    ASSERT_EQ(path_error(problem, path), "");
    ASSERT_EQ(static_cast<Time>(path.size()) - 1, *expected);
    Path again;
    query.cutoff = *expected - 1;
    ASSERT_EQ(find(again), PathOutcome::kAbove);
    ASSERT_TRUE(again.empty());
    query.cutoff = *expected;
    ASSERT_EQ(find(again), PathOutcome::kFound);
    ASSERT_EQ(again, path);
  }

  std::mt19937 random_;
  const bool conditional_;
};

class LowLevelFuzz : public ::testing::TestWithParam<bool> {};

TEST_P(LowLevelFuzz, AgreesWithATimeExpandedSearch) {
  int delayed = 0;
  int infeasible = 0;
  const int seeds = testing::fuzz_rounds(2000);
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fuzzer fuzzer(static_cast<unsigned>(seed), GetParam());
    fuzzer.run();
    if (HasFatalFailure()) return;
    delayed += fuzzer.delayed;
    infeasible += fuzzer.infeasible;
  }
  // Most cases must be worth something.
  EXPECT_GT(delayed, GetParam() ? 2 * seeds : 5 * seeds);
  EXPECT_GT(infeasible, seeds / 2);
}

INSTANTIATE_TEST_SUITE_P(, LowLevelFuzz, ::testing::Bool(),
                         [](const auto& all) { return all.param ? "AllKinds" : "Bars"; });

}  // namespace low_level_fuzz_test
}  // namespace grove
