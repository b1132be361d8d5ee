// SPDX-License-Identifier: MIT
// The free low level against its definition, and against the fixed one over all orders.
// GROVE_FUZZ_FACTOR multiplies the number of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <stdexcept>

#include "grove/baselines/baseline_search.h"
#include "grove/planning/free_low_level_search.h"
#include "grove/planning/low_level_search.h"
#include "grove/sequencing/k_best_sequences.h"
#include "tests/planning/free_reference.h"
#include "tests/planning/random_constraint.h"
#include "tests/planning/reference_search.h"
#include "tests/planning/single_agent.h"
#include "tests/support/fuzz_factor.h"

namespace grove {
namespace free_low_level_test {

using Outcome = FreeLowLevelSearch::Outcome;
using testing::free_reference_cost;
using testing::FreeProblem;
using testing::grid_of;
using testing::instance_of;
using testing::members_of;
using testing::path_error;
using testing::Problem;
using testing::SingleAgent;

// One agent, its class and both searches.
struct Agent {
  explicit Agent(const FreeProblem& given)
      : problem(given),
        instance(instance_of(given)),
        distances(instance),
        stops(instance, distances, 0),
        goals(stops, given.work),
        free(*given.grid),
        fixed(*given.grid) {
    for (LowLevel low_level :
         {LowLevel::kVisitedSets, LowLevel::kSingleLegs, LowLevel::kTimeIntervalForest})
      baselines.push_back(make_baseline_search(low_level, *given.grid));
  }

  Outcome find(Time cutoff, Path& found, const ConflictAvoidanceTable* others = nullptr) {
    return free.find(goals, problem.constraints, others, cutoff, Limits(), found);
  }
  // Of least cost, none if there is none. Checks the path.
  std::optional<Time> cost(const ConflictAvoidanceTable* others = nullptr) {
    const Outcome outcome = find(kNever, path, others);
    if (outcome == Outcome::kInfeasible) return std::nullopt;
    EXPECT_EQ(outcome, Outcome::kFound);
    if (outcome == Outcome::kFound) expect_valid(path);
    return static_cast<Time>(path.size()) - 1;
  }
  void expect_valid(const Path& found) {
    const Sequence sequence = realized_sequence(goals, found);
    Problem plain{problem.grid, problem.start, {}, problem.constraints};
    for (Stop stop : sequence) plain.goals.push_back(problem.stops[stop]);
    if (problem.destination) plain.goals.push_back(*problem.destination);
    EXPECT_EQ(path_error(plain, found), "");
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
                                    problem.constraints, nullptr, Limits(), found);
    if (outcome != LowLevelSearch::Outcome::kFound) return std::nullopt;
    return static_cast<Time>(found.size()) - 1;
  }
  std::optional<Time> fixed_cost_of_class() {
    std::optional<Time> best;
    for (const Sequence& s : members_of(problem.work, static_cast<int>(problem.stops.size())))
      if (const auto c = fixed_cost(s); c && (!best || *c < *best)) best = c;
    return best;
  }

  FreeProblem problem;
  Instance instance;
  DistanceFields distances;
  AgentStops stops;
  FreeGoals goals;
  FreeLowLevelSearch free;
  LowLevelSearch fixed;
  std::vector<std::unique_ptr<BaselineSearch>> baselines;
  Path path;
};

// Random problems on tiny maps, each made harder one constraint at a time.
class Fuzzer {
 public:
  // `conditional`: constraints of all kinds, not bars alone.
  Fuzzer(unsigned seed, bool conditional) : random_(seed), conditional_(conditional) {}

  void run() {
    const Grid grid = random_grid();
    Agent agent(random_problem(grid));
    ConflictAvoidanceTable others(grid);
    for (int n = below(4); n > 0; --n) others.add(random_walk(grid));
    for (int n = below(12); n >= 0; --n) {
      if (!check(agent, others)) return;
      agent.problem.constraints.push_back(random_constraint(agent));
      std::ranges::shuffle(agent.problem.constraints, random_);
    }
  }

  int checked = 0;
  int infeasible = 0;

 private:
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  Grid random_grid() {
    if (conditional_ && below(3) > 0) return testing::random_corridor_map(random_);
    switch (below(6)) {
      case 0:
        return grid_of({"......"});
      case 1:
        return grid_of({"@.@", "...", "@.@", "@.@"});
      case 2:
        return grid_of({"..@..", ".....", "..@.."});
      case 3:
        return grid_of({"....", ".@@.", "...."});
      default:
        break;
    }
    const int width = 1 + below(4);
    const int height = 1 + below(4);
    std::vector<bool> passable(static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(5) > 0;
    passable[0] = true;
    return Grid(width, height, passable);
  }

  Cell random_cell(const Grid& grid) {
    for (;;)
      if (const Cell cell = below(grid.cell_count()); grid.passable(cell)) return cell;
  }

  FreeProblem random_problem(const Grid& grid) {
    FreeProblem problem{&grid, random_cell(grid), {}, {}, {}, {}};
    for (int n = below(6); n > 0; --n)
      if (const Cell cell = random_cell(grid); std::ranges::count(problem.stops, cell) == 0)
        problem.stops.push_back(cell);
    if (problem.stops.empty() || below(2) == 0) problem.destination = random_cell(grid);
    problem.work = random_class(static_cast<int>(problem.stops.size()));
    return problem;
  }

  SequenceClass random_class(int n) {
    SequenceClass work;
    if (below(3) == 0) return work;
    Sequence order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), Stop{0});
    std::ranges::shuffle(order, random_);
    work.prefix.assign(order.begin(), order.begin() + below(below(2) == 0 ? n + 1 : 1));
    for (int stop = 0; stop < n; ++stop)
      if (below(3) == 0) work.forbidden_next |= StopSet{1} << stop;
    return work;
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

  // Often on the path, often on a stop or the destination.
  Constraint random_constraint(const Agent& agent) {
    const Path& path = agent.path;
    std::vector<Cell> goals = agent.problem.stops;
    if (agent.problem.destination) goals.push_back(*agent.problem.destination);
    if (conditional_ && below(2) == 0)
      return testing::random_conditional_constraint(*agent.problem.grid, path, goals, random_);
    Constraint c;
    const int at = below(static_cast<int>(path.size()));
    c.cell = path[at];
    c.begin = at;
    if (below(2) == 0) {
      c.cell = below(4) == 0 ? random_cell(*agent.problem.grid)
                             : goals[below(static_cast<int>(goals.size()))];
      c.begin = below(static_cast<int>(path.size()) + 6);
    }
    c.end = c.begin + (below(2) == 0 ? 0 : below(10));
    if (c.begin > 0 && below(8) == 0) c.end = kNever;
    if (below(3) == 0) {
      const auto neighbors = agent.problem.grid->neighbors(c.cell);
      if (at > 0 && path[at - 1] != c.cell && c.cell == path[at])
        c.from = path[at - 1];
      else if (!neighbors.empty())
        c.from = neighbors[below(static_cast<int>(neighbors.size()))];
    }
    return c;
  }

  bool check(Agent& agent, const ConflictAvoidanceTable& others) {
    ++checked;
    const std::optional<Time> expected = free_reference_cost(agent.problem);
    EXPECT_EQ(agent.cost(&others), expected);
    EXPECT_EQ(agent.cost(), expected);
    EXPECT_TRUE(agent.problem.stops.size() > 4 || agent.fixed_cost_of_class() == expected);
    check_cutoffs(agent, expected);
    if (!conditional_ && agent.problem.work == SequenceClass{}) check_baselines(agent, expected);
    if (!expected) ++infeasible;
    return expected.has_value() && !::testing::Test::HasFailure();
  }

  void check_cutoffs(Agent& agent, std::optional<Time> expected) {
    Path path;
    if (expected) {
      EXPECT_EQ(agent.find(*expected, path), Outcome::kFound);
      EXPECT_EQ(agent.find(*expected - 1, path), Outcome::kAbove);
    } else {
      EXPECT_NE(agent.find(below(30), path), Outcome::kFound);
    }
  }

  void check_baselines(Agent& agent, std::optional<Time> expected) {
    for (const auto& baseline : agent.baselines) {
      Path path;
      const auto find = [&](Time cutoff) {
        return baseline->find(0, agent.stops, agent.problem.constraints, cutoff, Limits(), path);
      };
      if (!expected) {
        EXPECT_EQ(find(kNever), BaselineSearch::Outcome::kInfeasible);
        continue;
      }
      ASSERT_EQ(find(*expected), BaselineSearch::Outcome::kFound);
      EXPECT_EQ(static_cast<Time>(path.size()) - 1, *expected);
      agent.expect_valid(path);
      EXPECT_EQ(find(*expected - 1), BaselineSearch::Outcome::kAbove);
    }
  }

  std::mt19937 random_;
  const bool conditional_;
};

class FreeLowLevelFuzz : public ::testing::TestWithParam<bool> {};

TEST_P(FreeLowLevelFuzz, AgreesWithItsDefinition) {
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

INSTANTIATE_TEST_SUITE_P(, FreeLowLevelFuzz, ::testing::Bool(),
                         [](const auto& all) { return all.param ? "AllKinds" : "Bars"; });

// Many stops, so that the completions are a graph that holds the good sequences alone.
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

  // After each constraint more: no sequence cheaper than the answer has a cheaper path, and one
  // that is not dearer has a path as cheap.
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
  static constexpr std::size_t kMostSequences = 100;

  // A cell of its path; sometimes for ever if it need not be visited.
  Constraint bar(const Agent& agent) {
    const int t = 1 + static_cast<int>(random_() % (agent.path.size() - 1));
    const Cell cell = agent.path[t];
    const bool needed =
        agent.stops.stop_at(cell) != AgentStops::kNoStop || cell == problem_.destination;
    if (random_() % 2 == 0 && !needed) return {cell, kNoCell, t, kNever};
    return {cell, kNoCell, t, random_() % 4 == 0 ? t + 12 : t};
  }

  // A cell of the largest connected part.
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
    const CostMatrix& matrix = agent.stops.completions().matrix();
    KBestSequences best(make_rtsp_solver(RtspBackend::kAuto, matrix, limits), matrix, limits);
    for (std::size_t rank = 0; rank < kMostSequences && best.resolve(rank, cost - 1) < cost; ++rank)
      EXPECT_GE(agent.fixed_cost(best.sequence(rank)).value_or(kNever), cost);
  }

  std::mt19937 random_;
  std::optional<Grid> grid_;
  FreeProblem problem_;
};

TEST(FreeLowLevel, IsExactWhereTheSequenceGraphIsBounded) {
  for (int seed = 0; seed < testing::fuzz_rounds(6); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ManyStops(static_cast<unsigned>(seed), seed % 2 == 0).check();
    if (HasFailure()) return;
  }
}

FreeProblem corridor(const Grid& grid, std::vector<Cell> stops, std::optional<Cell> destination) {
  return {&grid, 0, std::move(stops), destination, {}, {}};
}

TEST(FreeLowLevel, ChoosesTheOrder) {
  const Grid grid = grid_of({"......"});
  Agent agent(corridor(grid, {5, 1, 3}, 2));
  EXPECT_EQ(agent.cost(), 8);
  EXPECT_EQ(realized_sequence(agent.goals, agent.path), (Sequence{1, 2, 0}));
}

// What comes after the prefix is not counted before it, nor what may not come next.
TEST(FreeLowLevel, KeepsToItsClass) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3, 5}, 0);
  problem.work = {{1}, 0b100};  // 3 first, then not 5
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), 3 + 2 + 4 + 5);
  EXPECT_EQ(realized_sequence(agent.goals, agent.path), (Sequence{1, 0, 2}));
}

TEST(FreeLowLevel, AnEmptyClassHasNoPath) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3}, 0);
  problem.work.forbidden_next = 0b11;
  EXPECT_EQ(Agent(problem).cost(), std::nullopt);
}

TEST(FreeLowLevel, RejectsAPrefixThatIsNone) {
  const Grid grid = grid_of({"......"});
  for (const Sequence& prefix : {Sequence{1, 1}, Sequence{2}, Sequence{200}}) {
    FreeProblem problem = corridor(grid, {1, 3}, 0);
    problem.work.prefix = prefix;
    EXPECT_THROW(Agent{problem}, std::invalid_argument);
  }
}

// Without a destination: waits near the stop that may be rested on, not on the one barred for ever.
TEST(FreeLowLevel, ACellBarredForEverIsNoPlaceToRest) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3}, std::nullopt);
  problem.constraints = {{3, kNoCell, 10, kNever}};
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), 5);
  EXPECT_EQ(realized_sequence(agent.goals, agent.path), (Sequence{1, 0}));
}

// Who comes to 3 early may not rest there and cannot get out again in time.
TEST(FreeLowLevel, AGateSparesThoseWhoComeLateEnoughToRest) {
  const Grid grid = grid_of({"...."});
  FreeProblem problem = corridor(grid, {3}, std::nullopt);
  problem.constraints = {
      {3, kNoCell, 0, 6, ConstraintKind::kNoRestBy}, {2, kNoCell, 4, 6}, {2, 3, 0, 20}};
  EXPECT_EQ(Agent(problem).cost(), 8);
}

TEST(FreeLowLevel, TellsNoRestInTimeFromNoneBelowTheCutoff) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3}, std::nullopt);
  problem.constraints = {{1, kNoCell, 0, 4, ConstraintKind::kRestBy}};
  Agent agent(problem);
  Path path;
  EXPECT_EQ(agent.find(3, path), Outcome::kAbove);
  EXPECT_EQ(agent.find(4, path), Outcome::kInfeasible);
  EXPECT_EQ(agent.find(kNever, path), Outcome::kInfeasible);
  agent.problem.constraints[0].end = 5;
  EXPECT_EQ(agent.find(4, path), Outcome::kAbove);
  EXPECT_EQ(agent.find(5, path), Outcome::kFound);
  EXPECT_EQ(path.back(), 1);
}

// Without a destination the stop it rests on is the last one: it cannot be the first one too.
TEST(FreeLowLevel, DoesNotRestOnTheStopThatMustBeFirst) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 3, 5}, std::nullopt);
  problem.work.forbidden_next = 0b010;  // 1 or 5 first
  problem.constraints = {{3, kNoCell, 20, kNever}, {5, kNoCell, 20, kNever}};
  EXPECT_EQ(Agent(problem).cost(), 5 + 4);  // 5 first, back to 1; by 1 first it would end in 20
}

TEST(FreeLowLevel, AStopThatIsBarredTooSoonIsProvenAtOnce) {
  const Grid grid = grid_of({"......"});
  FreeProblem problem = corridor(grid, {1, 2, 3, 5}, 0);
  problem.constraints = {{5, kNoCell, 5, kNever}};
  Agent agent(problem);
  EXPECT_EQ(agent.cost(), std::nullopt);
  EXPECT_EQ(agent.free.expanded(), 0);
}

// The door shuts behind whoever visits the last stop in time; many orders, all hopeless.
TEST(FreeLowLevel, ADoorThatShutsIsProvenWithoutTryingAllOrders) {
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

// The same door, shut for long: far too dear for the cutoff.
TEST(FreeLowLevel, ADoorThatShutsForLongIsProvenAboveWithoutTryingAllOrders) {
  const Grid grid = grid_of({"........@.", "..........", "........@.", "........@."});
  FreeProblem problem = corridor(grid, {39}, 20);
  for (Cell cell = 1; problem.stops.size() < 20; ++cell)
    if (grid.passable(cell) && cell != 18) problem.stops.push_back(cell);
  problem.constraints = {{18, kNoCell, 13, 500}};
  Agent agent(problem);
  Path path;
  EXPECT_EQ(agent.find(100, path), Outcome::kAbove);
  EXPECT_LT(agent.free.expanded(), 20'000);
  problem.constraints.push_back({20, kNoCell, 0, 100, ConstraintKind::kRestBy});
  Agent in_time(problem);
  EXPECT_EQ(in_time.cost(), std::nullopt);
  EXPECT_LT(in_time.free.expanded(), 20'000);
}

// The short way to the destination is shut before all stops can have been visited: what is known of
// the way around must keep the search from trying all orders.
TEST(FreeLowLevel, ADoorThatShutsMakesTheLastLegDearer) {
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

// The destination is free late: any sequence will do.
TEST(FreeLowLevel, ALateRestIsFoundWithoutTryingAllOrders) {
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

TEST(FreeLowLevel, SaysAboveOnlyForTheCutoff) {
  const Grid grid = grid_of({"......"});
  Agent agent(corridor(grid, {5, 1}, 0));
  Path path{7};
  EXPECT_EQ(agent.find(9, path), Outcome::kAbove);
  EXPECT_EQ(path, Path{7});
  EXPECT_EQ(agent.find(10, path), Outcome::kFound);
  agent.problem.constraints = {{0, kNoCell, 50, 60}};
  EXPECT_EQ(agent.find(60, path), Outcome::kAbove);
  EXPECT_EQ(agent.find(61, path), Outcome::kFound);
}

TEST(FreeLowLevel, StopsWithoutAnAnswerWhenALimitStrikes) {
  const Grid grid = grid_of({"......"});
  Agent agent(corridor(grid, {5, 1}, 0));
  Limits limits;
  limits.set_deadline(Limits::Clock::now() - std::chrono::seconds(1));
  Path path;
  EXPECT_EQ(agent.free.find(agent.goals, {}, nullptr, kNever, limits, path), Outcome::kStopped);
  Limits memory;
  memory.set_memory_limit(1);
  EXPECT_EQ(agent.free.find(agent.goals, {}, nullptr, kNever, memory, path), Outcome::kStopped);
}

TEST(FreeLowLevel, APathOutsideTheClassRealizesNothing) {
  const Grid grid = grid_of({"......"});
  const Agent agent(corridor(grid, {5, 1}, 0));
  EXPECT_THROW(realized_sequence(agent.goals, {0, 1, 0}), std::invalid_argument);
  EXPECT_THROW(realized_sequence(agent.goals, {}), std::invalid_argument);
}

}  // namespace free_low_level_test
}  // namespace grove
