// SPDX-License-Identifier: MIT
// Compares FixedOrderSipp with a search over all time steps. GROVE_FUZZ_FACTOR multiplies the
// number of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planning/fixed_order_sipp.h"
#include "tests/planning/random_cases.h"
#include "tests/planning/reference_search.h"
#include "tests/planning/single_agent.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace low_level_fuzz_test {

using testing::NaiveConflicts;
using testing::path_error;
using testing::Problem;
using testing::random_cell;
using testing::random_walk;
using testing::reference_conflicts;
using testing::reference_cost;
using testing::SingleAgent;

// Random problems on tiny maps, to which constraints are added one at a time.
class Fuzzer {
 public:
  // `conditional`: uses constraints of all kinds on the path, not only vertex and edge constraints.
  Fuzzer(unsigned seed, bool conditional) : random_(seed), conditional_(conditional) {}

  void run() {
    const Grid grid = random_grid();
    FixedOrderSipp search(grid);
    for (int i = 0; i < 4; ++i) run_agent(grid, search);
  }

  int delayed = 0;
  int infeasible = 0;

 private:
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  Grid random_grid() {
    return conditional_ && below(3) > 0 ? testing::random_corridor_map(random_)
                                        : testing::random_small_map(random_);
  }

  void run_agent(const Grid& grid, FixedOrderSipp& search) {
    std::vector<Cell> tasks;
    for (int n = below(5); n > 0; --n)
      if (const Cell cell = random_cell(grid, random_); std::ranges::count(tasks, cell) == 0)
        tasks.push_back(cell);
    std::optional<Cell> destination;
    if (tasks.empty() || below(3) > 0)
      destination = !tasks.empty() && below(4) == 0 ? tasks.back() : random_cell(grid, random_);
    const SingleAgent agent(grid, random_cell(grid, random_), tasks, destination);
    Problem problem{&grid, agent.goals.start(), tasks, {}};
    if (destination) problem.goals.push_back(*destination);
    make_harder(problem, agent, search);
  }

  void make_harder(Problem& problem, const SingleAgent& agent, FixedOrderSipp& search) {
    NaiveConflicts others;
    ConflictAvoidanceTable table(*problem.grid);
    for (int n = below(4); n > 0; --n) {
      others.paths.push_back(random_walk(*problem.grid, random_));
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

  Constraint random_constraint(const Problem& problem, const Path& path) {
    return conditional_ && below(2) == 0
               ? testing::random_conditional_constraint(*problem.grid, path, problem.goals, random_)
               : testing::random_bar(*problem.grid, path, problem.goals, random_);
  }

  bool check(const Problem& problem, const SingleAgent& agent, FixedOrderSipp& search,
             const ConflictAvoidanceTable& table, const NaiveConflicts& others, Path& path) {
    const std::optional<Time> expected = reference_cost(problem);
    check_once(problem, agent, search, nullptr, expected, path);
    check_once(problem, agent, search, &table, expected, path);
    if (!expected || ::testing::Test::HasFatalFailure()) return false;
    if (*expected > agent.goals.distance(agent.goals.start(), 0))
      ++delayed;
    else  // guaranteed by the proof: without delay, the path has the fewest conflicts possible
      EXPECT_EQ(others.conflicts(path), reference_conflicts(problem, others, *expected));
    return true;
  }

  void check_once(const Problem& problem, const SingleAgent& agent, FixedOrderSipp& search,
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
    ASSERT_EQ(find(again), PathOutcome::kAboveCutoff);
    ASSERT_TRUE(again.empty());
    query.cutoff = *expected;
    ASSERT_EQ(find(again), PathOutcome::kFound);
    ASSERT_EQ(again, path);
  }

  std::mt19937 random_;
  const bool conditional_;
};

class FixedOrderSippFuzz : public ::testing::TestWithParam<bool> {};

TEST_P(FixedOrderSippFuzz, AgreesWithTimeExpandedSearch) {
  int delayed = 0;
  int infeasible = 0;
  const int seeds = testing::fuzz_rounds(1000);
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fuzzer fuzzer(static_cast<unsigned>(seed), GetParam());
    fuzzer.run();
    if (HasFatalFailure()) return;
    delayed += fuzzer.delayed;
    infeasible += fuzzer.infeasible;
  }
  // Enough cases must be non-trivial.
  EXPECT_GT(delayed, GetParam() ? 2 * seeds : 5 * seeds);
  EXPECT_GT(infeasible, seeds / 2);
}

INSTANTIATE_TEST_SUITE_P(, FixedOrderSippFuzz, ::testing::Bool(),
                         [](const auto& all) { return all.param ? "AllKinds" : "Bars"; });

}  // namespace low_level_fuzz_test
}  // namespace grove::detail
