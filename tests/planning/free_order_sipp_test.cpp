// SPDX-License-Identifier: MIT
// Tests single-agent search that chooses the order of the stops, against a search by definition and
// against FixedOrderSipp over all orders. GROVE_FUZZ_FACTOR multiplies the number of cases.
#include "planning/free_order_sipp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <stdexcept>

#include "planning/fixed_order_sipp.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/direct_legs.h"
#include "sequencing/k_best_sequences.h"
#include "tests/planning/free_problems.h"
#include "tests/planning/free_reference.h"
#include "tests/planning/reference_search.h"
#include "tests/planning/single_agent.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace free_order_sipp_test {

using Outcome = PathOutcome;
using testing::free_reference_cost;
using testing::FreeAgent;
using testing::FreeProblem;
using testing::grid_of;
using testing::members_of;
using testing::path_error;
using testing::Problem;
using testing::SingleAgent;

// An agent, its sequence class and both low-level searches.
struct Agent : FreeAgent {
  explicit Agent(const FreeProblem& given)
      : FreeAgent(given),
        direct(by_direct_legs(*this)),
        direct_goals(stops, given.work, direct),
        free(*given.grid),
        fixed(*given.grid) {}

  static CostToGo by_direct_legs(const FreeAgent& agent) {
    const CostMatrix& matrix = agent.stops.cost_to_go().matrix();
    const CostToGo graph = CostToGo::as_graph(
        matrix, [&agent, matrix] { return direct_legs(agent.instance, 0, matrix); });
    return graph.of_class(agent.problem.work).value_or(graph);
  }
  // Like cost(), but takes the cost-to-go from a graph of the sequences that paths can realize by
  // direct legs.
  std::optional<Time> direct_cost(const ConflictAvoidanceTable* others) {
    Path found;
    const Outcome outcome =
        free.find(direct_goals, {problem.constraints, others, kNever}, Limits(), found);
    EXPECT_NE(outcome, Outcome::kStopped);
    if (outcome != Outcome::kFound) return std::nullopt;
    expect_valid(found);
    return static_cast<Time>(found.size()) - 1;
  }

  Outcome find(Time cutoff, Path& found, const ConflictAvoidanceTable* others = nullptr) {
    return free.find(goals, {problem.constraints, others, cutoff}, Limits(), found);
  }
  // Finds a path, checks it and returns its cost. Returns nullopt if there is no path.
  std::optional<Time> cost(const ConflictAvoidanceTable* others = nullptr) {
    const Outcome outcome = find(kNever, path, others);
    if (outcome == Outcome::kInfeasible) return std::nullopt;
    EXPECT_EQ(outcome, Outcome::kFound);
    if (outcome == Outcome::kFound) expect_valid(path);
    return static_cast<Time>(path.size()) - 1;
  }
  void expect_valid(const Path& found) {
    const Sequence sequence = realized_sequence(goals, found);
    EXPECT_EQ(testing::path_error(problem, sequence, found), "");
    EXPECT_TRUE(
        std::equal(problem.work.prefix.begin(), problem.work.prefix.end(), sequence.begin()));
    const std::size_t free_from = problem.work.prefix.size();
    EXPECT_TRUE(sequence.size() == free_from ||
                (problem.work.forbidden_next >> sequence[free_from] & 1) == 0);
  }
  std::optional<Time> fixed_cost(const Sequence& sequence) {
    const std::vector<TaskIndex> tasks(sequence.begin(), sequence.end());
    Path found;
    const auto outcome = fixed.find(GoalSequence(instance, distances, 0, tasks),
                                    {problem.constraints}, Limits(), found);
    if (outcome != Outcome::kFound) return std::nullopt;
    return static_cast<Time>(found.size()) - 1;
  }
  std::optional<Time> fixed_cost_of_class() {
    std::optional<Time> best;
    for (const Sequence& s : members_of(problem.work, static_cast<int>(problem.stops.size())))
      if (const auto c = fixed_cost(s); c && (!best || *c < *best)) best = c;
    return best;
  }

  CostToGo direct;
  SequenceStages direct_goals;
  FreeOrderSipp free;
  FixedOrderSipp fixed;
  Path path;
};

// Random problems on tiny maps, to which constraints are added one at a time.
class Fuzzer {
 public:
  // `conditional`: uses constraints of all kinds on the path, not only vertex and edge constraints.
  Fuzzer(unsigned seed, bool conditional) : problems_(seed, conditional) {}

  void run() {
    const Grid grid = problems_.grid();
    Agent agent(problems_.problem(grid));
    ConflictAvoidanceTable others(grid);
    for (int n = problems_.below(4); n > 0; --n) others.add(problems_.walk(grid));
    for (int n = problems_.below(12); n >= 0; --n) {
      if (!check(agent, others)) return;
      problems_.make_harder(agent.problem, agent.path);
    }
  }

  int checked = 0;
  int infeasible = 0;

 private:
  bool check(Agent& agent, const ConflictAvoidanceTable& others) {
    ++checked;
    const std::optional<Time> expected = free_reference_cost(agent.problem);
    EXPECT_EQ(agent.cost(&others), expected);
    EXPECT_EQ(agent.cost(), expected);
    EXPECT_EQ(agent.direct_cost(&others), expected);
    EXPECT_TRUE(agent.problem.stops.size() > 4 || agent.fixed_cost_of_class() == expected);
    check_cutoffs(agent, expected);
    if (!expected) ++infeasible;
    return expected.has_value() && !::testing::Test::HasFailure();
  }

  void check_cutoffs(Agent& agent, std::optional<Time> expected) {
    Path path;
    if (expected) {
      EXPECT_EQ(agent.find(*expected, path), Outcome::kFound);
      EXPECT_EQ(agent.find(*expected - 1, path), Outcome::kAboveCutoff);
    } else {
      EXPECT_NE(agent.find(problems_.below(30), path), Outcome::kFound);
    }
  }

  testing::FreeProblems problems_;
};

class FreeOrderSippFuzz : public ::testing::TestWithParam<bool> {};

TEST_P(FreeOrderSippFuzz, AgreesWithSearchByDefinition) {
  int checked = 0;
  int infeasible = 0;
  const int seeds = testing::fuzz_rounds(1200);
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fuzzer fuzzer(static_cast<unsigned>(seed), GetParam());
    fuzzer.run();
    if (HasFailure()) return;
    checked += fuzzer.checked;
    infeasible += fuzzer.infeasible;
  }
  EXPECT_GT(checked, 2 * seeds);
  EXPECT_GT(infeasible, seeds / 4);
}

// Up to 2^n sequences have the same cost, but only in a few of them the agent visits each stop when
// it first passes it.
TEST(FreeOrderSipp, RowOfTasksNeedsFewLabels) {
  for (const int n : {24, 64}) {
    const Grid grid = grid_of({std::string(static_cast<std::size_t>(n) + 4, '.'),
                               std::string(static_cast<std::size_t>(n) + 4, '.')});
    for (const Cell start : {1, 10, n + 3})
      for (const bool has_destination : {true, false}) {
        FreeProblem problem{&grid, start, {}, {}, {}, {}};
        for (Cell cell = 2; cell < n + 2; ++cell) problem.stops.push_back(cell);
        if (has_destination) problem.destination = 0;
        Agent agent(problem);
        const Time far = n + 1;
        const Time shut = start >= far ? start - 2 : std::min(far - start, start - 2) + far - 2;
        const Time open = std::max(far - start, 0) + std::max(far, start);
        EXPECT_EQ(agent.cost(), has_destination ? open : start < 2 ? far - start : shut);
        EXPECT_LT(agent.free.expanded(), 200 * n);
      }
  }
}

// The limit applies to the labels of one call, however many labels earlier calls expanded.
TEST(FreeOrderSipp, StopsAtTheGivenNumberOfLabels) {
  const Grid grid = grid_of(std::vector<std::string>(12, "............"));
  FreeProblem problem{&grid, 0, {17, 30, 44, 50, 71, 90, 100, 119, 130, 141}, 143, {}, {}};
  problem.constraints = {{17, kNoPlace, 0, 70}, {130, kNoPlace, 0, 70}};
  Agent agent(problem);
  for (const std::int64_t most : {1, 77, 300, 2, 1000}) {
    const std::int64_t before = agent.free.expanded();
    Path path;
    const PathQuery query{.constraints = problem.constraints, .label_limit = most};
    EXPECT_EQ(agent.free.find(agent.goals, query, Limits(), path), Outcome::kStopped);
    EXPECT_EQ(agent.free.expanded() - before, most);
  }
}

INSTANTIATE_TEST_SUITE_P(, FreeOrderSippFuzz, ::testing::Bool(),
                         [](const auto& all) { return all.param ? "AllKinds" : "Bars"; });

// A problem whose cost-to-go is a graph of only the low-cost sequences, because it has too many
// stops for a table.
class ManyStops {
 public:
  ManyStops(unsigned seed, bool with_destination) : random_(seed) {
    std::vector<bool> passable(kSide * kSide);
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = random_() % 6 > 0;
    grid_.emplace(kSide, kSide, passable);
    const DistanceField field = distance_field(*grid_, some_passable());
    std::vector<Cell> cells;
    for (Cell c = 0; c < grid_->cell_count(); ++c)
      if (field[c] < kNever) cells.push_back(c);
    std::ranges::shuffle(cells, random_);
    const std::size_t n = std::min<std::size_t>(18 + random_() % 7, cells.size() - 2);
    problem_ = {&*grid_, cells[0], {cells.begin() + 2, cells.begin() + 2 + n}, {}, {}, {}};
    if (with_destination) problem_.destination = cells[1];
  }

  // Adds constraints one at a time. Before each addition, FixedOrderSipp must find a path of the
  // same cost for the sequence that the path found realizes. It must find no cheaper path for any
  // sequence whose cost without constraints is lower; at most kMaxSequences of them are tested.
  void check() {
    Agent agent(problem_);
    for (int n = 0; n < 8; ++n) {
      const std::optional<Time> cost = agent.cost();
      if (!cost) return;
      EXPECT_EQ(agent.fixed_cost(realized_sequence(agent.goals, agent.path)), cost);
      expect_best(agent, *cost);
      agent.problem.constraints.push_back(bar(agent));
    }
  }

 private:
  static constexpr int kSide = 9;
  static constexpr std::size_t kMaxSequences = 100;

  // Returns a vertex constraint on a cell of the agent's path, sometimes without an end if the
  // agent need not visit that cell.
  Constraint bar(const Agent& agent) {
    const int t = 1 + static_cast<int>(random_() % (agent.path.size() - 1));
    const Cell cell = agent.path[t];
    const bool needed =
        agent.stops.stop_at(cell) != AgentStops::kNoStop || cell == problem_.destination;
    if (random_() % 2 == 0 && !needed) return {cell, kNoCell, t, kNever};
    return {cell, kNoCell, t, random_() % 4 == 0 ? t + 12 : t};
  }

  // Returns a cell of the largest connected component.
  Cell some_passable() {
    Cell best = 0;
    for (Cell c = 0; c < grid_->cell_count(); ++c)
      if (grid_->passable(c) && distance_count(c) > distance_count(best)) best = c;
    return best;
  }
  std::ptrdiff_t distance_count(Cell c) const {
    return std::ranges::count_if(distance_field(*grid_, c), [](Time d) { return d < kNever; });
  }

  void expect_best(Agent& agent, Time cost) {
    const Limits limits;
    const CostMatrix& matrix = agent.stops.cost_to_go().matrix();
    KBestSequences best(make_rtsp_solver(RtspBackend::kAuto, matrix, limits), matrix, limits);
    for (std::size_t rank = 0; rank < kMaxSequences && best.resolve(rank, cost - 1) < cost; ++rank)
      EXPECT_GE(agent.fixed_cost(best.sequence(rank)).value_or(kNever), cost);
  }

  std::mt19937 random_;
  std::optional<Grid> grid_;
  FreeProblem problem_;
};

TEST(FreeOrderSipp, IsExactWithABoundedSequenceGraph) {
  for (int seed = 0; seed < testing::fuzz_rounds(6); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ManyStops(static_cast<unsigned>(seed), seed % 2 == 0).check();
    if (HasFailure()) return;
  }
}

FreeProblem corridor(const Grid& grid, std::vector<Cell> stops, std::optional<Cell> destination) {
  return {&grid, 0, std::move(stops), destination, {}, {}};
}

TEST(FreeOrderSipp, ChoosesTheCheapestOrder) {
  const Grid grid = grid_of({"......"});
  Agent agent(corridor(grid, {5, 1, 3}, 2));
  EXPECT_EQ(agent.cost(), 8);
  EXPECT_EQ(realized_sequence(agent.goals, agent.path), (Sequence{1, 2, 0}));
}

// A later stop does not count as visited before the prefix is complete, and a forbidden stop does
// not directly follow the prefix.
TEST(FreeOrderSipp, StaysWithinItsSequenceClass) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3, 5}, 0);
  problem.work = {{1}, 0b100};  // cell 3 first, and cell 5 not next
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), 3 + 2 + 4 + 5);
  EXPECT_EQ(realized_sequence(agent.goals, agent.path), (Sequence{1, 0, 2}));
}

TEST(FreeOrderSipp, EmptyClassHasNoPath) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3}, 0);
  problem.work.forbidden_next = 0b11;
  EXPECT_EQ(Agent(problem).cost(), std::nullopt);
}

TEST(FreeOrderSipp, RejectsInvalidPrefix) {
  const Grid grid = grid_of({"......"});
  for (const Sequence& prefix : {Sequence{1, 1}, Sequence{2}, Sequence{200}}) {
    FreeProblem problem = corridor(grid, {1, 3}, 0);
    problem.work.prefix = prefix;
    EXPECT_THROW(Agent{problem}, std::invalid_argument);
  }
}

// Without a destination the agent rests on the only stop that is not barred forever.
TEST(FreeOrderSipp, CellBarredForeverCannotBeTheRest) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3}, std::nullopt);
  problem.constraints = {{3, kNoCell, 10, kNever}};
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), 5);
  EXPECT_EQ(realized_sequence(agent.goals, agent.path), (Sequence{1, 0}));
}

// An agent that reaches 3 early may not rest there and cannot leave again in time.
TEST(FreeOrderSipp, GateKeepsLabelsThatArriveLateEnoughToRest) {
  const Grid grid = grid_of({"...."});
  FreeProblem problem = corridor(grid, {3}, std::nullopt);
  problem.constraints = {
      {3, kNoCell, 0, 6, ConstraintKind::kNoRestBy}, {2, kNoCell, 4, 6}, {2, 3, 0, 20}};
  EXPECT_EQ(Agent(problem).cost(), 8);
}

TEST(FreeOrderSipp, DistinguishesInfeasibleRestFromAboveCutoff) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3}, std::nullopt);
  problem.constraints = {{1, kNoCell, 0, 4, ConstraintKind::kRestBy}};
  Agent agent(problem);
  Path path;
  EXPECT_EQ(agent.find(3, path), Outcome::kAboveCutoff);
  EXPECT_EQ(agent.find(4, path), Outcome::kInfeasible);
  EXPECT_EQ(agent.find(kNever, path), Outcome::kInfeasible);
  agent.problem.constraints[0].end = 5;
  EXPECT_EQ(agent.find(4, path), Outcome::kAboveCutoff);
  EXPECT_EQ(agent.find(5, path), Outcome::kFound);
  EXPECT_EQ(path.back(), 1);
}

// Without a destination the agent rests on its last stop, so it cannot rest on a stop that must be
// first.
TEST(FreeOrderSipp, DoesNotRestOnStopThatMustBeFirst) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3, 5}, std::nullopt);
  problem.work.forbidden_next = 0b010;  // first stop: cell 1 or 5
  problem.constraints = {{3, kNoCell, 20, kNever}, {5, kNoCell, 20, kNever}};
  // The agent visits 5 first and then returns to 1. If it visited 1 first, it would have to rest on
  // 3 or 5, which are barred from time 20 on.
  EXPECT_EQ(Agent(problem).cost(), 5 + 4);
}

TEST(FreeOrderSipp, StopBarredTooSoonIsInfeasibleWithoutSearch) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 2, 3, 5}, 0);
  problem.constraints = {{5, kNoCell, 5, kNever}};
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), std::nullopt);
  EXPECT_EQ(agent.free.expanded(), 0);
}

// The door closes before an agent that has visited the stop behind it can return. All of the many
// orders are infeasible.
TEST(FreeOrderSipp, ClosingDoorIsInfeasibleWithFewLabels) {
  const Grid grid = grid_of({"........@.", "..........", "........@.", "........@."});
  for (const int n : {12, 20}) {
    FreeProblem problem = corridor(grid, {39}, 20);
    for (Cell cell = 1; static_cast<int>(problem.stops.size()) < n; ++cell)
      if (grid.passable(cell) && cell != 18) problem.stops.push_back(cell);
    problem.constraints = {{18, kNoCell, 13, kNever}};
    Agent agent(problem);
    EXPECT_EQ(agent.cost(), std::nullopt);
    EXPECT_LT(agent.free.expanded(), 200'000);
  }
}

// The same door, closed for a long time, so that every path costs far more than the cutoff.
TEST(FreeOrderSipp, LongClosedDoorIsAboveCutoffWithFewLabels) {
  const Grid grid = grid_of({"........@.", "..........", "........@.", "........@."});
  FreeProblem problem = corridor(grid, {39}, 20);
  for (Cell cell = 1; problem.stops.size() < 20; ++cell)
    if (grid.passable(cell) && cell != 18) problem.stops.push_back(cell);
  problem.constraints = {{18, kNoCell, 13, 500}};
  Agent agent(problem);
  Path path;
  EXPECT_EQ(agent.find(100, path), Outcome::kAboveCutoff);
  EXPECT_LT(agent.free.expanded(), 20'000);
  problem.constraints.push_back({20, kNoCell, 0, 100, ConstraintKind::kRestBy});
  Agent in_time(problem);
  EXPECT_EQ(in_time.cost(), std::nullopt);
  EXPECT_LT(in_time.free.expanded(), 20'000);
}

// The short route to the destination closes before the agent can have visited all stops. The lower
// bound on the detour must prevent the search from trying all orders.
TEST(FreeOrderSipp, ClosingDoorRaisesTheCostOfTheLastLeg) {
  const Grid grid = grid_of({"...........@.", ".@.@.@.@.@.@.", "...........@.", "@@@@@@@@@@.@.",
                             "...........@.", ".@@@@@@@@@@@.", "............."});
  for (const std::optional<Cell> destination : {std::optional<Cell>(52), std::optional<Cell>()})
    for (const int n : {7, 12, 20}) {
      FreeProblem problem = corridor(grid, {}, destination);
      for (Cell cell = 1; static_cast<int>(problem.stops.size()) < n; cell += n < 12 ? 4 : 1)
        if (grid.passable(cell) && cell % 13 < 11 && cell < 39) problem.stops.push_back(cell);
      problem.constraints = {{57, kNoCell, 25, kNever}};
      Agent agent(problem);
      const std::optional<Time> cost = agent.cost();
      if (n < 12) {
        EXPECT_EQ(cost, free_reference_cost(problem));
      }
      EXPECT_LT(agent.free.expanded(), 30'000);
    }
}

// The agent can rest on its destination only late, so every sequence is optimal.
TEST(FreeOrderSipp, LateRestIsFoundWithoutEnumeratingOrders) {
  const Grid grid = grid_of({"..........", "..........", "..........", ".........."});
  for (const int n : {12, 24}) {
    FreeProblem problem = corridor(grid, {}, 39);
    for (Cell cell = 1; static_cast<int>(problem.stops.size()) < n; ++cell)
      problem.stops.push_back(cell);
    problem.constraints = {{39, kNoCell, 100, 100}};
    Agent agent(problem);
    EXPECT_EQ(agent.cost(), 101);
    EXPECT_LT(agent.free.expanded(), 100'000);
  }
}

TEST(FreeOrderSipp, ReturnsAboveCutoffOnlyBelowTheOptimum) {
  const Grid grid = grid_of({"......"});
  Agent agent(corridor(grid, {5, 1}, 0));
  Path path{7};
  EXPECT_EQ(agent.find(9, path), Outcome::kAboveCutoff);
  EXPECT_EQ(path, Path{7});
  EXPECT_EQ(agent.find(10, path), Outcome::kFound);
  agent.problem.constraints = {{0, kNoCell, 50, 60}};
  EXPECT_EQ(agent.find(60, path), Outcome::kAboveCutoff);
  EXPECT_EQ(agent.find(61, path), Outcome::kFound);
}

TEST(FreeOrderSipp, StopsWithoutAnswerWhenALimitIsReached) {
  const Grid grid = grid_of({"......"});
  Agent agent(corridor(grid, {5, 1}, 0));
  Limits limits;
  limits.set_deadline(testing::kPast);
  Path path;
  EXPECT_EQ(agent.free.find(agent.goals, {}, limits, path), Outcome::kStopped);
  Limits memory;
  memory.set_memory_limit(1);
  EXPECT_EQ(agent.free.find(agent.goals, {}, memory, path), Outcome::kStopped);
}

// Memory suffices only for the labels of the order 1, 4, in which the agent may rest only from time
// 31 on. The search must stop instead of returning such a path, because the order 4, 1 is cheaper.
TEST(FreeOrderSipp, PathFoundWithoutAllLabelsIsNotReturned) {
  constexpr int kSide = 700;
  std::vector<bool> passable(kSide * kSide);
  std::fill_n(passable.begin(), 6, true);
  const Grid grid(kSide, kSide, passable);
  FreeProblem problem{&grid, 2, {1, 4}, {}, {{0, 1}, 0}, {{4, kNoCell, 30, 30}}};
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), 31);  // this call also creates labels for its three states
  SequenceStages both(agent.stops, {});
  const PathQuery query{problem.constraints};
  Limits limits;
  limits.set_memory_limit(resident_bytes() + (std::size_t{4} << 20));
  Path path;
  EXPECT_EQ(agent.free.find(both, query, limits, path), Outcome::kStopped);
  EXPECT_EQ(limits.reason(), StopReason::kMemory);
  ASSERT_EQ(agent.free.find(both, query, Limits(), path), Outcome::kFound);
  EXPECT_EQ(path.size(), 6u);
}

TEST(FreeOrderSipp, PathOutsideTheClassRealizesNoSequence) {
  const Grid grid = grid_of({"......"});
  const Agent agent(corridor(grid, {5, 1}, 0));
  EXPECT_THROW(realized_sequence(agent.goals, {0, 1, 0}), std::invalid_argument);
  EXPECT_THROW(realized_sequence(agent.goals, {}), std::invalid_argument);
}

}  // namespace free_order_sipp_test
}  // namespace grove::detail
