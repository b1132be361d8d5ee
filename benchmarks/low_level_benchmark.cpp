// SPDX-License-Identifier: MIT
// Measures one call of the low level with a given number of goals on a 32x32 map and at most a
// given number of constraints. Conflicts with nine other agents break ties. Each constraint forbids
// a random cell of the path under the previous constraints, or the move to this cell, at the time
// when the path is there. This is the worst case for a branch of the constraint tree.
//
// The time shown is the median over the cases of one pass. labels and max_labels are the median and
// the maximum number of labels expanded in a call. Maps are generated; the Moving AI maps in the
// directory $GROVE_MOVINGAI, if it is set, are measured as well.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "io/map_file.h"
#include "planning/fixed_order_sipp.h"
#include "planning/free_order_sipp.h"

namespace grove::detail {
namespace {

constexpr int kSide = 32;
constexpr int kCases = 48;
constexpr int kOthers = 9;
constexpr int kRoom = 5;  // side of a room including one wall, cells

using Random = std::mt19937;

int below(Random& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}

Grid empty_map(Random&) {
  return Grid(kSide, kSide, std::vector<bool>(kSide * kSide, true));
}

Grid random_map(Random& random) {
  std::vector<bool> passable(kSide * kSide);
  for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(random, 5) > 0;
  return Grid(kSide, kSide, passable);
}

// Returns a map of rooms of 4x4 cells with a door in each wall between two rooms.
Grid room_map(Random& random) {
  std::vector<bool> passable(kSide * kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      passable[y * kSide + x] = x % kRoom != kRoom - 1 && y % kRoom != kRoom - 1;
  for (int wall = kRoom - 1; wall + 1 < kSide; wall += kRoom)
    for (int room = 0; room < kSide; room += kRoom) {
      const int door = room + below(random, std::min(kRoom - 1, kSide - room));
      passable[door * kSide + wall] = true;
      passable[wall * kSide + door] = true;
    }
  return Grid(kSide, kSide, passable);
}

std::optional<Grid> moving_ai_map(const std::string& name) {
  const char* folder = std::getenv("GROVE_MOVINGAI");
  if (!folder) return std::nullopt;
  const std::filesystem::path file = std::filesystem::path(folder) / (name + ".map");
  return std::filesystem::exists(file) ? std::optional(read_map(file)) : std::nullopt;
}

// Returns the cells of the largest connected component, in random order.
std::vector<Cell> connected_cells(const Grid& grid, Random& random) {
  std::vector<Cell> best;
  for (Cell source = 0; source < grid.cell_count(); ++source) {
    if (!grid.passable(source)) continue;
    const DistanceField distance = distance_field(grid, source);
    std::vector<Cell> part;
    for (Cell c = 0; c < grid.cell_count(); ++c)
      if (distance[c] < kNever) part.push_back(c);
    if (part.size() > best.size()) best = part;
    if (2 * best.size() > static_cast<std::size_t>(grid.passable_count())) break;
  }
  std::ranges::shuffle(best, random);
  return best;
}

// An agent with a fixed sequence in which it always visits the nearest remaining goal next.
struct Case {
  Case(const Grid& grid, const std::vector<Cell>& cells, int goals);
  PathQuery query() const { return {.constraints = constraints, .others = &others}; }

  std::unique_ptr<Instance> instance;
  std::unique_ptr<DistanceFields> distances;
  std::unique_ptr<GoalSequence> goals;
  ConflictAvoidanceTable others;
  std::vector<Constraint> constraints;
};

std::vector<TaskIndex> nearest_first(const Instance& instance, const DistanceFields& distances) {
  std::vector<TaskIndex> order = instance.agent(0).tasks;
  Cell at = instance.agent(0).start;
  for (auto next = order.begin(); next != order.end(); ++next) {
    std::iter_swap(next, std::ranges::min_element(next, order.end(), {}, [&](TaskIndex t) {
                     return distances.to_task(t)[at];
                   }));
    at = instance.task(*next).cell;
  }
  return order;
}

Case::Case(const Grid& grid, const std::vector<Cell>& cells, int goal_count) : others(grid) {
  InstanceBuilder builder(grid);
  builder.add_agent("a", grid.position(cells[0]), grid.position(cells[1]));
  for (int k = 2; k < goal_count + 1; ++k)
    builder.add_task(fmt::format("t{}", k), grid.position(cells[k]), std::vector<std::string>{"a"});
  instance = std::make_unique<Instance>(std::move(builder).build());
  distances = std::make_unique<DistanceFields>(*instance);
  goals = std::make_unique<GoalSequence>(*instance, *distances, 0,
                                         nearest_first(*instance, *distances));
}

Constraint bar_on_path(const Path& path, Random& random) {
  const int t = 1 + below(random, static_cast<int>(path.size()) - 1);
  Constraint c{path[t], kNoCell, t, t};
  if (path[t - 1] != path[t] && below(random, 4) == 0) c.from = path[t - 1];
  return c;
}

// Adds at most `count` constraints to case i, each on the path that `search` finds under the
// previous ones. They are therefore the worst case only for this search.
template <class Search>
void pile_up_constraints(std::vector<Case>& cases, Search& search, FixedOrderSipp& check, int count,
                         std::size_t i, Random& random) {
  Case& c = cases[i];
  Path path;
  Path ignored;
  for (int tries = 0; static_cast<int>(c.constraints.size()) < count && tries < 4 * count;
       ++tries) {
    search.find(c, i, path);
    c.constraints.push_back(bar_on_path(path, random));
    if (check.find(*c.goals, c.query(), Limits(), ignored) != PathOutcome::kFound)
      c.constraints.pop_back();
  }
}

template <class Search>
std::vector<Case> make_cases(const Grid& grid, int goals, int constraints, Random& random) {
  FixedOrderSipp check(grid);
  std::vector<Case> cases;
  std::vector<Path> paths;
  for (int i = 0; i < kCases; ++i) {
    cases.emplace_back(grid, connected_cells(grid, random), goals);
    check.find(*cases.back().goals, {}, Limits(), paths.emplace_back());
  }
  Search search(grid, cases);
  for (int i = 0; i < kCases; ++i) {
    for (int k = 1; k <= kOthers; ++k) cases[i].others.add(paths[(i + k) % kCases]);
    pile_up_constraints(cases, search, check, constraints, i, random);
  }
  return cases;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<int>(values.size()) / 2);
  return values[values.size() / 2];
}

// The two searches, with a common interface.
class Fixed {
 public:
  explicit Fixed(const Grid& grid, const std::vector<Case>&) : search_(grid) {}
  void find(const Case& c, std::size_t, Path& path) {
    search_.find(*c.goals, c.query(), Limits(), path);
  }
  std::int64_t expanded() const { return search_.expanded(); }

 private:
  FixedOrderSipp search_;
};

class Free {
 public:
  Free(const Grid& grid, const std::vector<Case>& cases) : search_(grid) {
    for (const Case& c : cases) {
      stops_.push_back(std::make_unique<AgentStops>(*c.instance, *c.distances, 0));
      goals_.push_back(std::make_unique<SequenceStages>(*stops_.back(), SequenceClass{}));
    }
  }
  void find(const Case& c, std::size_t i, Path& path) {
    search_.find(*goals_[i], c.query(), Limits(), path);
  }
  std::int64_t expanded() const { return search_.expanded(); }

 private:
  FreeOrderSipp search_;
  std::vector<std::unique_ptr<AgentStops>> stops_;
  std::vector<std::unique_ptr<SequenceStages>> goals_;
};

template <class Search>
void measure(benchmark::State& state, const Grid& grid, Random& random) {
  const std::vector<Case> cases = make_cases<Search>(grid, static_cast<int>(state.range(0)),
                                                     static_cast<int>(state.range(1)), random);
  Search search(grid, cases);
  Path path;
  std::vector<double> seconds(cases.size());
  std::vector<double> labels(cases.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::int64_t before = search.expanded();
      const auto begin = std::chrono::steady_clock::now();
      search.find(cases[i], i, path);
      seconds[i] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      labels[i] = static_cast<double>(search.expanded() - before);
    }
    state.SetIterationTime(median(seconds));
  }
  state.counters["labels"] = median(labels);
  state.counters["max_labels"] = *std::ranges::max_element(labels);
}

template <class Search>
void find_path(benchmark::State& state, Grid (*make_map)(Random&)) {
  Random random(1);
  const Grid grid = make_map(random);
  measure<Search>(state, grid, random);
}

template <class Search>
void find_path_on(benchmark::State& state, const std::string& map) {
  Random random(1);
  if (const std::optional<Grid> grid = moving_ai_map(map))
    measure<Search>(state, *grid, random);
  else
    state.SkipWithError("set GROVE_MOVINGAI to the folder of this map");
}

void settings(benchmark::internal::Benchmark* b) {
  b->ArgNames({"goals", "constraints"})->ArgsProduct({{5, 10, 20}, {0, 20, 60}});
  b->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(200);
}

template <class Search>
void register_benchmarks(const std::string& name) {
  const auto add = [&](const std::string& map, auto... run) {
    benchmark::RegisterBenchmark((name + "/" + map).c_str(), run...)->Apply(settings);
  };
  add("empty", find_path<Search>, empty_map);
  add("random", find_path<Search>, random_map);
  add("room", find_path<Search>, room_map);
  for (const std::string map : {"empty-32-32", "random-32-32-20", "room-32-32-4"})
    add(map, find_path_on<Search>, map);
}

const bool kRegistered = [] {
  register_benchmarks<Fixed>("fixed");
  register_benchmarks<Free>("free");
  return true;
}();

}  // namespace
}  // namespace grove::detail
