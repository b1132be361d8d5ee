// SPDX-License-Identifier: MIT
// Compares MDDs, and the search for collision-free paths in two agents' MDDs, with enumeration of
// all paths. GROVE_FUZZ_FACTOR multiplies the number of cases.
#include "planning/mdd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>

#include "planning/joint_mdd_search.h"
#include "tests/planning/free_reference.h"
#include "tests/planning/random_cases.h"
#include "tests/planning/single_agent.h"
#include "tests/planning/step_rules.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace mdd_test {

using Outcome = MddBuilder::Outcome;
using Paths = std::set<Path>;
using testing::free_reference_cost;
using testing::FreeProblem;
using testing::grid_of;
using testing::members_of;
using testing::satisfies;
using testing::StepRules;

constexpr std::size_t kPlenty = 1'000'000;

// Enumerates all paths of the problem that take `cost` steps and end with a move.
class Walks {
 public:
  Walks(const FreeProblem& problem, Time cost)
      : problem_(problem),
        rules_(*problem.grid, problem.constraints),
        members_(members_of(problem.work, static_cast<int>(problem.stops.size()))),
        cost_(cost) {
    walk_.push_back(problem.start);
    if (!rules_.barred(problem.start, 0)) extend();
  }
  const Paths& found() const { return found_; }

 private:
  void extend() {
    const auto time = static_cast<Time>(walk_.size());
    if (time > cost_) {
      if (is_path()) found_.insert(walk_);
      return;
    }
    const Cell from = walk_.back();
    if (time < cost_) step(from, time);
    for (Cell to : problem_.grid->neighbors(from)) step(to, time);
  }
  void step(Cell to, Time time) {
    if (rules_.barred(to, time)) return;
    walk_.push_back(to);
    extend();
    walk_.pop_back();
  }

  bool is_path() const {
    return std::ranges::all_of(
               problem_.constraints,
               [&](const Constraint& c) { return satisfies(*problem_.grid, walk_, c); }) &&
           std::ranges::any_of(members_, [&](const Sequence& s) { return realizes(s); });
  }
  bool realizes(const Sequence& sequence) const {
    auto visit = walk_.begin();
    for (const Stop stop : sequence) {
      visit = std::find(visit, walk_.end(), problem_.stops[stop]);
      if (visit == walk_.end()) return false;
    }
    const Cell rest =
        problem_.destination ? *problem_.destination : problem_.stops[sequence.back()];
    return walk_.back() == rest;
  }

  const FreeProblem& problem_;
  const StepRules rules_;
  const std::vector<Sequence> members_;
  const Time cost_;
  Path walk_;
  Paths found_;
};

// Adds all paths of the MDD that start with `path` and continue at `node`.
void add_paths(const Mdd& graph, Mdd::NodeId node, Path& path, Paths& all) {
  path.push_back(graph.state(node));
  if (static_cast<Time>(path.size()) > graph.cost()) all.insert(path);
  for (const auto next : graph.successors(node)) add_paths(graph, next, path, all);
  path.pop_back();
}

Paths paths_of(const Mdd& graph) {
  Paths all;
  if (graph.empty()) return all;
  Path path;
  const auto first = graph.layer(0);
  for (auto node = first.first; node < first.end; ++node) add_paths(graph, node, path, all);
  return all;
}

Cell at(const Path& path, Time time) {
  return path[std::min<std::size_t>(static_cast<std::size_t>(time), path.size() - 1)];
}

bool collide(const Path& a, const Path& b) {
  for (Time t = 0; t < static_cast<Time>(std::max(a.size(), b.size())); ++t) {
    if (at(a, t) == at(b, t)) return true;
    if (t > 0 && at(a, t) == at(b, t - 1) && at(b, t) == at(a, t - 1)) return true;
  }
  return false;
}

bool compatible(const Paths& all, const Paths& others) {
  return std::ranges::any_of(all, [&](const Path& a) {
    return std::ranges::any_of(others, [&](const Path& b) { return !collide(a, b); });
  });
}

struct Agent : testing::FreeAgent {
  explicit Agent(const FreeProblem& given) : FreeAgent(given), builder(*given.grid) {}

  Outcome build(Time cost, std::size_t max_nodes = kPlenty) {
    return builder.build(goals, problem.constraints, cost, max_nodes, Limits(), graph);
  }

  MddBuilder builder;
  Mdd graph;
};

class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed) : random_(seed) {}

  void run() {
    const Grid grid = testing::random_corridor_map(random_);
    JointMddSearch pair(grid);
    const std::unique_ptr<Agent> a = random_agent(grid);
    const std::unique_ptr<Agent> b = random_agent(grid);
    for (int round = 0; round < 4; ++round) {
      const Paths of_a = check(*a);
      const Paths of_b = check(*b);
      if (of_a.empty() || of_b.empty() || of_a.size() * of_b.size() > kPlenty) return;
      const bool fit = compatible(of_a, of_b);
      const Dependence expected = fit ? Dependence::kIndependent : Dependence::kDependent;
      EXPECT_EQ(pair.find(a->graph, b->graph, kPlenty, Limits()), expected);
      EXPECT_EQ(pair.find(b->graph, a->graph, kPlenty, Limits()), expected);
      const Dependence little = pair.find(a->graph, b->graph, below(5), Limits());
      EXPECT_TRUE(little == expected || little == Dependence::kUnknown);
      ++(fit ? fits : collides);
      constrain(*a, of_a);
      constrain(*b, of_b);
    }
  }

  int fits = 0;
  int collides = 0;

 private:
  static constexpr Time kMaxCost = 9;

  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  Cell random_cell(const Grid& grid) {
    for (;;)
      if (const Cell cell = below(grid.cell_count()); grid.passable(cell)) return cell;
  }

  std::unique_ptr<Agent> random_agent(const Grid& grid) {
    FreeProblem problem{&grid, random_cell(grid), {}, {}, {}, {}};
    for (int n = below(4); n > 0; --n)
      if (const Cell cell = random_cell(grid); std::ranges::count(problem.stops, cell) == 0)
        problem.stops.push_back(cell);
    if (problem.stops.empty() || below(2) == 0) problem.destination = random_cell(grid);
    for (Stop stop = 0; stop < problem.stops.size() && below(3) == 0; ++stop)
      problem.work.forbidden_next |= StopSet{1} << stop;
    return std::make_unique<Agent>(problem);
  }

  // Compares all paths of one cost and returns them. The cost exceeds the agent's least cost by a
  // random number from 0 to 2. Returns no paths if it is above kMaxCost or no path exists.
  Paths check(Agent& agent) {
    const std::optional<Time> least = free_reference_cost(agent.problem);
    if (!least) {
      EXPECT_EQ(agent.build(below(kMaxCost)), Outcome::kNone);
      return {};
    }
    const Time cost = *least + std::max(0, below(5) - 2);
    if (cost > kMaxCost) return {};
    const Paths all = Walks(agent.problem, cost).found();
    EXPECT_EQ(agent.build(cost), all.empty() ? Outcome::kNone : Outcome::kBuilt);
    EXPECT_TRUE(paths_of(agent.graph) == all);
    return all;
  }

  void constrain(Agent& agent, const Paths& paths) {
    const Path& path = *std::next(paths.begin(), below(static_cast<int>(paths.size())));
    std::vector<Cell> goals = agent.problem.stops;
    if (agent.problem.destination) goals.push_back(*agent.problem.destination);
    if (below(2) == 0) {
      agent.problem.constraints.push_back(
          testing::random_conditional_constraint(*agent.problem.grid, path, goals, random_));
      return;
    }
    const int t = below(static_cast<int>(path.size()));
    Constraint bar{path[t], kNoCell, t, t + below(3)};
    if (t > 0 && path[t - 1] != path[t] && below(3) == 0) bar.from = path[t - 1];
    agent.problem.constraints.push_back(bar);
  }

  std::mt19937 random_;
};

TEST(MddFuzz, AgreesWithEnumeration) {
  const int seeds = testing::fuzz_rounds(700);
  int fits = 0;
  int collides = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fuzzer fuzzer(static_cast<unsigned>(seed));
    fuzzer.run();
    if (::testing::Test::HasFailure()) return;
    fits += fuzzer.fits;
    collides += fuzzer.collides;
  }
  EXPECT_GT(fits, seeds / 4);
  EXPECT_GT(collides, seeds / 4);
}

// There are 6 paths of least cost on an open 3 x 3 grid, but only one node for each cell.
TEST(Mdd, MergesNodesThatDifferOnlyInThePast) {
  const Grid grid = grid_of({"...", "...", "..."});
  FreeProblem problem{&grid, 0, {}, 8, {}, {}};
  Agent agent(problem);
  ASSERT_EQ(agent.build(4), Outcome::kBuilt);
  EXPECT_EQ(agent.graph.node_count(), 9);
  EXPECT_EQ(agent.graph.cost(), 4);
  EXPECT_EQ(paths_of(agent.graph).size(), 6u);
  problem.constraints = {{4, 1, 0, kNever, ConstraintKind::kNoRestBy}};
  ASSERT_EQ(Agent(problem).build(4), Outcome::kBuilt);
}

TEST(Mdd, ReportsWhichLimitWasReached) {
  const Grid grid = grid_of({"...", "...", "..."});
  Agent agent(FreeProblem{&grid, 0, {}, 8, {}, {}});
  EXPECT_EQ(agent.build(4, 5), Outcome::kTooLarge);
  EXPECT_TRUE(agent.graph.empty());
  EXPECT_EQ(agent.build(3), Outcome::kNone);
  Limits limits;
  limits.set_deadline(testing::kPast);
  EXPECT_EQ(agent.builder.build(agent.goals, {}, 4, kPlenty, limits, agent.graph),
            Outcome::kStopped);
}

TEST(Mdd, IsTooLargeIfTheCostsToGoAre) {
  const Grid grid = grid_of({".....", ".....", ".....", ".....", "....."});
  std::vector<Cell> stops;
  for (Cell cell = 1; cell < 24; ++cell) stops.push_back(cell);
  Agent agent(FreeProblem{&grid, 0, stops, 24, {}, {}});
  EXPECT_EQ(agent.build(80), Outcome::kTooLarge);
  EXPECT_TRUE(agent.graph.empty());
}

// One agent rests on the path of an agent that arrives there later.
TEST(JointMddSearch, CountsTheRestOfTheAgentThatFinishesFirst) {
  const Grid grid = grid_of({"....."});
  Agent rests(FreeProblem{&grid, 3, {}, 2, {}, {}});
  Agent passes(FreeProblem{&grid, 0, {}, 4, {}, {}});
  ASSERT_EQ(rests.build(1), Outcome::kBuilt);
  ASSERT_EQ(passes.build(4), Outcome::kBuilt);
  JointMddSearch pair(grid);
  EXPECT_EQ(pair.find(rests.graph, passes.graph, kPlenty, Limits()), Dependence::kDependent);
}

}  // namespace mdd_test
}  // namespace grove::detail
