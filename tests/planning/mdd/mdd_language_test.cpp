// SPDX-License-Identifier: MIT
// Compares MDDs with a time-expanded graph that is built only from the definitions of the
// constraints. Both are layered graphs, which the test reads in parallel as automata: they have the
// same paths if every continuation of a path in one is also possible in the other. The test
// therefore does not list paths, and maps, costs and time windows can be larger than in
// mdd_test.cpp. FreeOrderSipp must find the least cost that has a path. GROVE_FUZZ_FACTOR
// multiplies the number of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "planning/corridors.h"
#include "planning/free_order_sipp.h"
#include "planning/mdd.h"
#include "sequencing/cost_matrix.h"
#include "tests/planning/free_reference.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"
#include "tests/support/sanitizers.h"

namespace grove::detail {
namespace mdd_language_test {

using testing::FreeProblem;
using testing::grid_of;
using testing::instance_of;

constexpr std::size_t kPlenty = 1'000'000;
constexpr std::size_t kMaxReadings = 20'000;  // per pair of graphs
constexpr Time kMaxCost = 60;

// State of an agent in the time-expanded graph, without the time.
struct AgentState {
  Cell cell;
  std::uint32_t counted;  // bit i: stop i is counted as visited
  int last;               // the stop counted last; -1: none, or there is a destination
  Cell entered_from;      // cell from which it entered its corridor after time 0, or kNoCell
  Cell entered_at;        // inner cell that it entered from there, or kNoCell
  friend auto operator<=>(const AgentState&, const AgentState&) = default;
};

class TimeExpanded {
 public:
  explicit TimeExpanded(const FreeProblem& problem) : problem_(problem) {
    std::set<AgentState> first;
    if (!barred(problem.start, 0)) arrive({problem.start, 0, -1, kNoCell, kNoCell}, first);
    layers_.push_back(std::move(first));
  }

  // Returns the least cost of a path, or nullopt if no path costs at most `most`.
  std::optional<Time> min_cost(Time most) {
    for (Time cost = 0; cost <= most; ++cost)
      if (ends_at(cost)) return cost;
    return std::nullopt;
  }

  // Returns the nodes on paths of this cost, by time.
  std::vector<std::set<AgentState>> nodes_of(Time cost) {
    std::vector<std::set<AgentState>> useful(static_cast<std::size_t>(cost) + 1);
    grow(cost);
    for (const AgentState& m : layers_[cost])
      if (cost == 0 && may_end(m, cost)) useful[cost].insert(m);
    if (cost == 0) return useful;
    for (Time time = cost - 1; time >= 0; --time)
      for (const AgentState& m : layers_[time])
        for (const AgentState& next : steps(m, time + 1)) {
          const bool ends = time + 1 == cost && next.cell != m.cell && may_end(next, cost);
          if (ends) useful[cost].insert(next);
          if (ends || (time + 1 < cost && useful[time + 1].contains(next))) useful[time].insert(m);
        }
    return useful;
  }

  // Returns the states after a step from `from` that arrives at `time`.
  std::vector<AgentState> steps(const AgentState& from, Time time) const {
    std::set<AgentState> there;
    if (!barred(from.cell, time)) arrive(from, there);
    for (const Cell to : problem_.grid->neighbors(from.cell)) {
      if (barred(to, time) || move_barred(from, to, time)) continue;
      AgentState m = from;
      m.cell = to;
      if (!inner(to))
        m.entered_from = m.entered_at = kNoCell;
      else if (!inner(from.cell))
        m.entered_from = from.cell, m.entered_at = to;
      arrive(m, there);
    }
    return {there.begin(), there.end()};
  }

 private:
  bool inner(Cell cell) const { return problem_.grid->neighbors(cell).size() == 2; }

  void grow(Time time) {
    while (static_cast<Time>(layers_.size()) <= time) {
      std::set<AgentState> next;
      for (const AgentState& m : layers_.back())
        for (const AgentState& there : steps(m, static_cast<Time>(layers_.size())))
          next.insert(there);
      layers_.push_back(std::move(next));
    }
  }
  bool ends_at(Time cost) {
    const auto useful = nodes_of(cost);
    return !useful.front().empty();
  }

  void arrive(const AgentState& m, std::set<AgentState>& there) const {
    there.insert(m);
    const auto& prefix = problem_.work.prefix;
    const auto many = static_cast<std::size_t>(std::popcount(m.counted));
    for (int stop = 0; stop < static_cast<int>(problem_.stops.size()); ++stop) {
      if (problem_.stops[stop] != m.cell || (m.counted >> stop & 1) != 0) continue;
      if (many < prefix.size() && prefix[many] != stop) continue;
      if (many == prefix.size() && (problem_.work.forbidden_next >> stop & 1) != 0) continue;
      const bool remember = !problem_.destination;
      there.insert(
          {m.cell, m.counted | 1U << stop, remember ? stop : -1, m.entered_from, m.entered_at});
    }
  }
  bool barred(Cell cell, Time time) const {
    return std::ranges::any_of(problem_.constraints, [&](const Constraint& c) {
      return c.kind == ConstraintKind::kVertexOrEdge && c.from == kNoCell && c.cell == cell &&
             c.begin <= time && time <= c.end;
    });
  }
  bool move_barred(const AgentState& from, Cell to, Time time) const {
    return std::ranges::any_of(problem_.constraints, [&](const Constraint& c) {
      if (c.from != from.cell || c.cell != to || time < c.begin || c.end < time) return false;
      if (c.kind == ConstraintKind::kVertexOrEdge) return true;
      return c.kind == ConstraintKind::kNoTraversal && from.entered_from != kNoCell &&
             !(from.entered_from == to && from.entered_at == from.cell);
    });
  }
  // Returns whether an agent that arrived here at `time` may rest here forever.
  bool may_end(const AgentState& m, Time time) const {
    if (std::popcount(m.counted) != static_cast<int>(problem_.stops.size())) return false;
    const Cell rest = problem_.destination ? *problem_.destination : problem_.stops[m.last];
    if (m.cell != rest) return false;
    return std::ranges::none_of(problem_.constraints, [&](const Constraint& c) {
      if (c.kind == ConstraintKind::kRestBy) return c.cell != rest || time > c.end;
      if (c.cell != rest) return false;
      if (c.kind == ConstraintKind::kNoRestBy) return time <= c.end;
      return c.kind == ConstraintKind::kVertexOrEdge && c.from == kNoCell && c.begin <= c.end &&
             c.end >= time;
    });
  }

  const FreeProblem& problem_;
  std::vector<std::set<AgentState>> layers_;
};

// Reads both graphs in parallel. A reading is the pair of node sets, one per graph, that a path
// prefix reaches.
class SideBySide {
 public:
  SideBySide(const TimeExpanded& reference, const std::vector<std::set<AgentState>>& useful,
             const Mdd& graph)
      : reference_(reference), useful_(useful), graph_(graph) {}

  // Describes the first difference found in the first kMaxReadings readings, or returns "" if there
  // is none.
  std::string difference() {
    const auto first = graph_.layer(0);
    std::map<Cell, Reading> begin;
    for (const AgentState& m : useful_[0]) begin[m.cell].first.insert(m);
    for (auto node = first.first; node < first.end; ++node)
      begin[graph_.state(node)].second.insert(node);
    std::set<Reading> now;
    if (!put(begin, now)) return "layer 0";
    for (Time time = 1; time <= graph_.cost(); ++time) {
      std::set<Reading> next;
      for (const Reading& reading : now) {
        if (++readings_ > kMaxReadings) return {};
        std::map<Cell, Reading> there;
        for (const AgentState& m : reading.first)
          for (const AgentState& step : reference_.steps(m, time))
            if (useful_[time].contains(step) && (time < graph_.cost() || step.cell != m.cell))
              there[step.cell].first.insert(step);
        for (const auto node : reading.second)
          for (const auto step : graph_.successors(node)) {
            there[graph_.state(step)].second.insert(step);
            if (step < graph_.layer(time).first || step >= graph_.layer(time).end)
              return "no step to the next layer";
          }
        if (!put(there, next)) return "a step to time " + std::to_string(time);
      }
      now = std::move(next);
    }
    return {};
  }
  bool complete() const { return readings_ <= kMaxReadings; }

 private:
  using Reading = std::pair<std::set<AgentState>, std::set<Mdd::NodeId>>;

  static bool put(const std::map<Cell, Reading>& by_cell, std::set<Reading>& readings) {
    for (const auto& [cell, reading] : by_cell) {
      if (reading.first.empty() || reading.second.empty()) return false;
      readings.insert(reading);
    }
    return true;
  }

  const TimeExpanded& reference_;
  const std::vector<std::set<AgentState>>& useful_;
  const Mdd& graph_;
  std::size_t readings_ = 0;
};

// Returns whether each node is on a path and each successor is listed once.
bool is_tidy(const Mdd& graph) {
  std::vector<bool> entered(static_cast<std::size_t>(graph.node_count()), false);
  for (auto node = graph.layer(0).first; node < graph.layer(0).end; ++node) entered[node] = true;
  for (Time time = 0; time <= graph.cost(); ++time)
    for (auto node = graph.layer(time).first; node < graph.layer(time).end; ++node) {
      const auto steps = graph.successors(node);
      if (!entered[node] || steps.empty() != (time == graph.cost())) return false;
      if (std::set(steps.begin(), steps.end()).size() != steps.size()) return false;
      for (const auto step : steps) entered[step] = true;
    }
  return true;
}

class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed) : random_(seed) {}

  void run() {
    const Grid grid = random_grid();
    make_problem(grid);
    const Instance instance = instance_of(problem_);
    const DistanceFields distances(instance);
    AgentStops stops(instance, distances, 0);
    SequenceStages goals(stops, problem_.work);
    MddBuilder builder(grid);
    FreeOrderSipp search(grid);
    for (int round = 0; round < 6; ++round) {
      TimeExpanded reference(problem_);
      const std::optional<Time> least = reference.min_cost(kMaxCost);
      Path path;
      const auto outcome = search.find(
          goals, {.constraints = problem_.constraints, .cutoff = kMaxCost}, Limits(), path);
      ASSERT_EQ(outcome == PathOutcome::kFound, least.has_value());
      if (least) {
        ASSERT_EQ(static_cast<Time>(path.size()) - 1, *least);
      }
      for (Time more = -2; more <= 4; ++more) {
        const Time cost = least ? *least + more : below(20);
        if (cost > kMaxCost) break;
        check(reference, builder, goals, cost);
        if (::testing::Test::HasFatalFailure()) return;
      }
      if (!least) return;
      for (int n = 1 + below(4); n > 0; --n) constrain(path);
    }
  }

  int compared = 0;
  int incomplete = 0;
  int none = 0;

 private:
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
  template <class T>
  const T& any_of(const std::vector<T>& choices) {
    return choices[static_cast<std::size_t>(below(static_cast<int>(choices.size())))];
  }

  void check(TimeExpanded& reference, MddBuilder& builder, SequenceStages& goals, Time cost) {
    using Outcome = MddBuilder::Outcome;
    const auto useful = cost < 0 ? std::vector<std::set<AgentState>>(1) : reference.nodes_of(cost);
    Mdd graph;
    const Outcome outcome =
        builder.build(goals, problem_.constraints, cost, kPlenty, Limits(), graph);
    ASSERT_EQ(outcome, useful.front().empty() ? Outcome::kNone : Outcome::kBuilt) << cost;
    ASSERT_EQ(graph.empty(), outcome == Outcome::kNone);
    if (graph.empty()) {
      ++none;
      return;
    }
    ASSERT_EQ(graph.cost(), cost);
    ASSERT_TRUE(is_tidy(graph));
    SideBySide reading(reference, useful, graph);
    ASSERT_EQ(reading.difference(), "") << "cost " << cost;
    ++(reading.complete() ? compared : incomplete);
    Mdd small;
    const auto nodes = static_cast<std::size_t>(graph.node_count());
    ASSERT_NE(builder.build(goals, problem_.constraints, cost, nodes - 1, Limits(), small),
              Outcome::kBuilt);
    ASSERT_TRUE(small.empty());
  }

  Grid random_grid() {
    static const std::vector<std::vector<std::string>> maps = {
        {"..@@@@..", "........", "..@@@@.."},                     // a long corridor
        {"......", ".@@@@.", "......", ".@@@@.", "......"},       // two loops, as in the digit 8
        {"....", ".@@.", "...."},                                 // a ring
        {"@....@", "@.@@.@", "......", "@@.@@@"},                 // loops and tails
        {".......", "@@@@@@.", ".......", ".@@@@@@", "......."},  // a snake
        {"..@...@..", ".........", "..@...@.."},                  // doors in a row
    };
    if (below(2) == 0) return grid_of(any_of(maps));
    std::vector<std::string> rows(static_cast<std::size_t>(2 + below(4)));
    const int width = 3 + below(5);
    const int density = 1 + below(4);
    for (std::string& row : rows)
      for (int x = 0; x < width; ++x) row += below(9) < density ? '@' : '.';
    rows[0][0] = rows[0][1] = '.';
    return grid_of(rows);
  }

  void make_problem(const Grid& grid) {
    std::vector<Cell> cells;
    for (Cell cell = 0; cell < grid.cell_count(); ++cell)
      if (grid.passable(cell)) cells.push_back(cell);
    problem_ = {&grid, any_of(cells), {}, {}, {}, {}};
    cells = {problem_.start};
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const Cell next : grid.neighbors(cells[i]))
        if (std::ranges::count(cells, next) == 0) cells.push_back(next);
    // With 15 or more stops the cost-to-go is a graph of sequences instead of a table. Only a few
    // of these stops remain outside the prefix.
    const bool many = below(8) == 0 && cells.size() > 18;
    for (int n = many ? 15 + below(3) : below(6); n > 0; --n)
      if (const Cell cell = any_of(cells); std::ranges::count(problem_.stops, cell) == 0)
        problem_.stops.push_back(cell);
      else if (many)
        ++n;
    const int stops = static_cast<int>(problem_.stops.size());
    if (stops == 0 || below(2) == 0) problem_.destination = any_of(cells);
    const int prefix = many ? stops - below(3) : below(3) == 0 ? below(stops + 1) : 0;
    Sequence order;
    for (int stop = 0; stop < stops; ++stop) order.push_back(static_cast<Stop>(stop));
    std::shuffle(order.begin(), order.end(), random_);
    if (many) order_nearest_first(order);
    problem_.work.prefix.assign(order.begin(), order.begin() + prefix);
    if (below(2) == 0)
      for (int i = prefix; i < stops; ++i)
        if (below(3) == 0) problem_.work.forbidden_next |= StopSet{1} << order[i];
  }

  // Sorts the stops in the order in which a depth-first search discovers their cells, so that paths
  // in this order do not cost too much.
  void order_nearest_first(Sequence& order) const {
    std::map<Cell, int> found{{problem_.start, 0}};
    std::vector<Cell> stack{problem_.start};
    while (!stack.empty()) {
      const Cell cell = stack.back();
      stack.pop_back();
      for (const Cell next : problem_.grid->neighbors(cell))
        if (found.emplace(next, static_cast<int>(found.size())).second) stack.push_back(next);
    }
    std::ranges::sort(order, {}, [&](Stop stop) { return found[problem_.stops[stop]]; });
  }

  void constrain(const Path& path) {
    const Grid& grid = *problem_.grid;
    const auto cost = static_cast<Time>(path.size()) - 1;
    std::vector<Cell> goals = problem_.stops;
    if (problem_.destination) goals.push_back(*problem_.destination);
    const Time t = below(cost + 3);
    const Cell here = path[static_cast<std::size_t>(std::min(t, cost))];
    const Cell before = path[static_cast<std::size_t>(std::clamp(t - 1, 0, cost))];
    const Cell cell = below(3) == 0 ? any_of(goals) : here;
    const Time end = t + below(below(3) == 0 ? 14 : 4);
    auto& all = problem_.constraints;
    switch (below(12)) {
      case 0:
      case 1:
        all.push_back({cell, kNoCell, t - below(5), end});
        break;
      case 2:  // barred for long, sometimes with a short gap
        all.push_back({cell, kNoCell, 1 + below(3), end});
        all.push_back({cell, kNoCell, end + 1 + below(3), end + below(9)});
        break;
      case 3:
      case 4:
      case 5: {  // overlapping edge constraints
        const auto neighbors = grid.neighbors(cell);
        if (neighbors.empty()) break;
        const Cell from =
            before != cell && std::ranges::count(neighbors, before) > 0
                ? before
                : neighbors[static_cast<std::size_t>(below(static_cast<int>(neighbors.size())))];
        for (int n = 1 + below(3); n > 0; --n)
          all.push_back({cell, from, t - below(6), t + below(7)});
        break;
      }
      case 6:
      case 7:
      case 8:
      case 9: {
        std::vector<std::pair<Cell, Cell>> mouths;
        const Corridors corridors(grid);
        for (int corridor = 0; corridor < corridors.count(); ++corridor) {
          const auto row = corridors.places(corridor);
          mouths.emplace_back(row.front(), row[1]);
          mouths.emplace_back(row.back(), row[row.size() - 2]);
        }
        if (mouths.empty()) break;
        for (int n = 1 + below(3); n > 0; --n) {
          const auto [out, inner] = any_of(mouths);
          const Time last = below(8) == 0 ? kNever : end;
          all.push_back({out, inner, t - below(8), last, ConstraintKind::kNoTraversal});
        }
        break;
      }
      case 10:
        all.push_back({below(2) == 0 ? path.back() : any_of(goals), kNoCell, 0,
                       below(12) == 0 ? kNever : cost - 2 + below(8), ConstraintKind::kNoRestBy});
        break;
      default:
        if (below(3) == 0)
          all.push_back({below(3) == 0 ? any_of(goals) : path.back(), kNoCell, 0, cost + below(9),
                         ConstraintKind::kRestBy});
        else if (below(4) == 0)
          all.push_back({cell, kNoCell, t, kNever});
    }
  }

  std::mt19937 random_;
  FreeProblem problem_;
};

TEST(MddLanguage, EqualsThatOfTimeExpandedGraph) {
  const int seeds = testing::fuzz_rounds(60);
  int compared = 0;
  int incomplete = 0;
  int none = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fuzzer fuzzer(static_cast<unsigned>(seed));
    fuzzer.run();
    if (::testing::Test::HasFailure()) return;
    compared += fuzzer.compared;
    incomplete += fuzzer.incomplete;
    none += fuzzer.none;
  }
  EXPECT_GT(compared, 10 * seeds);
  EXPECT_LT(incomplete, seeds / 4);
  EXPECT_GT(none, 2 * seeds);
}

// Returns the sorted cells of each layer.
std::vector<std::vector<Cell>> cells_of(const Mdd& graph) {
  std::vector<std::vector<Cell>> layers;
  for (Time time = 0; !graph.empty() && time <= graph.cost(); ++time) {
    layers.emplace_back();
    for (auto node = graph.layer(time).first; node < graph.layer(time).end; ++node)
      layers.back().push_back(graph.state(node));
    std::ranges::sort(layers.back());
  }
  return layers;
}

// outside_bound() is a lower bound on the cost of the sequences that a sequence graph omits. An MDD
// of exactly this cost must have the same cells in each layer as an MDD from a wider graph.
TEST(MddLanguage, IsCompleteAtTheBoundOfTheSequenceGraph) {
  int at_the_bound = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const Grid grid = grid_of({".......@", ".@......", "....@...", ".@....@.", "........"});
    std::vector<Cell> cells;
    for (Cell cell = 0; cell < grid.cell_count(); ++cell)
      if (grid.passable(cell)) cells.push_back(cell);
    std::shuffle(cells.begin(), cells.end(), random);
    FreeProblem problem{&grid, cells[0], {cells.begin() + 1, cells.begin() + 16}, {}, {}, {}};
    if (seed % 2 == 0) problem.destination = cells[20];
    const Instance instance = instance_of(problem);
    const DistanceFields distances(instance);
    MddBuilder builder(grid);
    AgentStops narrow(instance, distances, 0);
    ASSERT_TRUE(narrow.cost_to_go().extend(0, Limits()));
    for (int more = 0; more < 3; ++more) {
      const Time cost = narrow.cost_to_go().outside_bound();
      AgentStops wide(instance, distances, 0);
      ASSERT_TRUE(wide.cost_to_go().extend(cost + 4, Limits()));
      Mdd graphs[2];
      SequenceStages few(narrow, {});
      SequenceStages all(wide, {});
      const auto of_few = builder.build(few, {}, cost, kPlenty, Limits(), graphs[0]);
      ASSERT_EQ(of_few, builder.build(all, {}, cost, kPlenty, Limits(), graphs[1])) << cost;
      ASSERT_TRUE(cells_of(graphs[0]) == cells_of(graphs[1])) << cost;
      at_the_bound += static_cast<int>(of_few == MddBuilder::Outcome::kBuilt);
      ASSERT_TRUE(narrow.cost_to_go().extend(cost, Limits()));
    }
  }
  EXPECT_GT(at_the_bound, 10);
}

// SequenceStages can be constructed with a CostToGo other than that of its AgentStops.
TEST(MddLanguage, WidensTheCostToGoOfItsStages) {
  const Grid grid = grid_of({"....."});
  FreeProblem problem{&grid, 0, {2}, 4, {}, {}};
  const Instance instance = instance_of(problem);
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  CostToGo others(stops.cost_to_go().matrix());
  SequenceStages goals(stops, {}, others);
  Mdd graph;
  EXPECT_EQ(MddBuilder(grid).build(goals, {}, 4, kPlenty, Limits(), graph),
            MddBuilder::Outcome::kBuilt);
}

// Whenever a limit is reached, the result must neither count as a proof that there is no path nor
// be a part of the MDD.
TEST(MddLanguage, IsCompleteOrEmptyWhenALimitIsReached) {
  const Grid grid = grid_of(std::vector<std::string>(40, std::string(40, '.')));
  FreeProblem problem{&grid, 0, {}, 1599, {}, {}};
  for (const Cell cell : {95, 1300, 777, 610, 1499, 38, 444, 820}) problem.stops.push_back(cell);
  const Instance instance = instance_of(problem);
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages goals(stops, {});
  Path path;
  FreeOrderSipp search(grid);
  ASSERT_EQ(search.find(goals, {}, Limits(), path), PathOutcome::kFound);
  const auto cost = static_cast<Time>(path.size()) + 3;
  Mdd whole;
  ASSERT_EQ(MddBuilder(grid).build(goals, {}, cost, kPlenty, Limits(), whole),
            MddBuilder::Outcome::kBuilt);
  const auto is_sound = [&](const Limits& limits) {
    Mdd graph;
    const auto outcome = MddBuilder(grid).build(goals, {}, cost, kPlenty, limits, graph);
    if (outcome == MddBuilder::Outcome::kStopped) return graph.empty();
    return outcome == MddBuilder::Outcome::kBuilt && graph.node_count() == whole.node_count();
  };
  const testing::ClockReadingLimit whole_run(testing::kUnlimitedReadings);
  EXPECT_TRUE(is_sound(whole_run));
  ASSERT_GT(whole_run.readings(), 3);
  const std::int64_t stride = 1 + whole_run.readings() / 60;
  for (std::int64_t readings = 0; readings < whole_run.readings(); readings += stride) {
    const testing::ClockReadingLimit limits(readings);
    EXPECT_TRUE(is_sound(limits)) << readings << " looks";
    EXPECT_EQ(limits.reason(), StopReason::kTime) << readings << " looks";
  }
#ifndef GROVE_SANITIZERS_MEMORY
  for (int step = 0; step < 16; ++step) {
    Limits limits;
    limits.set_memory_limit(resident_bytes() + (std::size_t{1} << 18) * step);
    EXPECT_TRUE(is_sound(limits)) << "memory " << step;
  }
#endif
}

}  // namespace mdd_language_test
}  // namespace grove::detail
