// SPDX-License-Identifier: MIT
// Tests ReservationTable, and compares both low levels with reservations to the same searches with
// equivalent constraints. GROVE_FUZZ_FACTOR multiplies the number of cases.
#include "planning/reservation_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "planning/fixed_order_sipp.h"
#include "planning/free_order_sipp.h"
#include "tests/planning/random_cases.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace reservation_table_test {

using testing::random_cell;

using Outcome = PathOutcome;

struct StayIs {
  Time first;
  Time last;
  Cell next;
  AgentIndex agent;
  friend bool operator==(const StayIs&, const StayIs&) = default;
};

std::vector<StayIs> stays_of(const ReservationTable& reservations, Cell cell) {
  std::vector<StayIs> result;
  for (const ReservationTable::Stay& s : reservations.stays(cell))
    result.push_back({s.first, s.last, s.next, s.agent});
  return result;
}

TEST(ReservationTable, HoldsTheStaysOfPathsInOrderOfTime) {
  const Grid grid = testing::grid_of({"....", "...."});
  ReservationTable reservations(grid);
  reservations.add(7, {4, 0, 0, 1, 0});
  reservations.add(3, {0, 1, 2, 3, 7});
  EXPECT_EQ(stays_of(reservations, 0),
            (std::vector<StayIs>{{0, 0, 1, 3}, {1, 2, 1, 7}, {4, kNever, kNoCell, 7}}));
  EXPECT_EQ(reservations.count(), 9);
  EXPECT_EQ(reservations.agent_at(0, 0), 3);
  EXPECT_EQ(reservations.agent_at(0, 2), 7);
  EXPECT_EQ(reservations.agent_at(0, 3), ReservationTable::kNoAgent);
  EXPECT_EQ(reservations.agent_at(0, kNever), 7);
  EXPECT_EQ(reservations.agent_at(6, 0), ReservationTable::kNoAgent);

  reservations.remove(7, {4, 0, 0, 1, 0});
  EXPECT_EQ(stays_of(reservations, 0), (std::vector<StayIs>{{0, 0, 1, 3}}));
  EXPECT_EQ(reservations.count(), 5);
  reservations.clear();
  EXPECT_EQ(reservations.count(), 0);
  EXPECT_TRUE(reservations.stays(0).empty());
}

Cell at(const Path& path, Time time) {
  return path[static_cast<std::size_t>(std::min<Time>(time, static_cast<Time>(path.size()) - 1))];
}

bool collide(const Path& a, const Path& b) {
  const auto end = static_cast<Time>(std::max(a.size(), b.size()));
  for (Time t = 0; t < end; ++t) {
    if (at(a, t) == at(b, t)) return true;
    if (t > 0 && at(a, t) == at(b, t - 1) && at(a, t - 1) == at(b, t)) return true;
  }
  return false;
}

void bar(const Path& path, std::vector<Constraint>& constraints) {
  for (Time t = 0; t < static_cast<Time>(path.size()); ++t) {
    constraints.push_back({path[t], kNoCell, t, t});
    if (t > 0 && path[t] != path[t - 1]) constraints.push_back({path[t - 1], path[t], t, t});
  }
  constraints.push_back({path.back(), kNoCell, static_cast<Time>(path.size()) - 1, kNever});
}

// Compares the answer for every move and rest with all reserved paths.
TEST(ReservationTable, AllowsArrivalAndRestOnlyOnFreePlaces) {
  const Grid grid = testing::grid_of({"...", "..."});
  const Path paths[] = {{0, 1, 1, 4, 5}, {2, 2, 2, 1, 0, 3}};
  for (const Time margin : {0, 1}) {
    ReservationTable reservations(grid, margin);
    for (AgentIndex agent = 0; agent < 2; ++agent) reservations.add(agent, paths[agent]);
    const auto is_taken = [&](Cell cell, Time time) {
      for (Time t = std::max(0, time - margin); t <= time + margin; ++t)
        for (const Path& path : paths)
          if (at(path, t) == cell) return true;
      return false;
    };
    for (Cell to = 0; to < grid.cell_count(); ++to) {
      for (Time time = 1; time < 10; ++time) {
        for (const Cell from : {0, 1, 2, 3, 4, 5}) {
          bool swaps = false;
          for (const Path& path : paths)
            swaps |= from != to && at(path, time - 1) == to && at(path, time) == from;
          EXPECT_EQ(reservations.may_arrive(from, to, time), !is_taken(to, time) && !swaps)
              << from << " to " << to << " at " << time << ", margin " << margin;
        }
        bool stays_free = true;
        for (Time t = time; t < 20; ++t) stays_free &= !is_taken(to, t);
        EXPECT_EQ(reservations.may_rest_from(to, time), stays_free) << to << " from " << time;
      }
    }
  }
}

// An agent with tasks among other agents that make random walks, on a random map.
class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed)
      : random_(seed), grid_(random_grid()), instance_(make_instance()) {}

  void check() {
    const DistanceFields distances(instance_);
    AgentStops stops(instance_, distances, 0);
    SequenceStages goals(stops, {});
    FreeOrderSipp search(grid_);
    FixedOrderSipp fixed(grid_);
    ReservationTable reservations(grid_);
    std::vector<Path> walks;
    for (int round = 0; round < 12 && !::testing::Test::HasFailure(); ++round) {
      if (!walks.empty() && below(3) == 0) {
        const auto gone = walks.begin() + below(static_cast<int>(walks.size()));
        const AgentIndex agent = names_[static_cast<std::size_t>(gone - walks.begin())];
        reservations.remove(agent, *gone);
        names_.erase(names_.begin() + (gone - walks.begin()));
        walks.erase(gone);
      } else if (Path walk = random_walk(); std::ranges::none_of(
                     walks, [&](const Path& other) { return collide(walk, other); })) {
        reservations.add(next_name_, walk);
        names_.push_back(next_name_++);
        walks.push_back(std::move(walk));
      }
      compare(goals, search, reservations, walks);
      compare(random_order(distances), fixed, reservations, walks);
    }
  }

  int compared = 0;
  int found = 0;

 private:
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  Grid random_grid() {
    const int width = 2 + below(5);
    const int height = 1 + below(5);
    std::vector<bool> passable(static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(6) > 0;
    passable[0] = passable[1] = true;
    return Grid(width, height, passable);
  }
  Instance make_instance() {
    InstanceBuilder builder(grid_);
    const bool rests_anywhere = below(3) == 0;
    std::optional<Position> goal;
    if (!rests_anywhere) goal = grid_.position(random_cell(grid_, random_));
    builder.add_agent("a", grid_.position(random_cell(grid_, random_)), goal);
    std::vector<Cell> cells;
    for (int n = below(5) + (rests_anywhere ? 1 : 0); n > 0; --n)
      if (const Cell cell = random_cell(grid_, random_); std::ranges::count(cells, cell) == 0)
        cells.push_back(cell);
    for (Cell cell : cells)
      builder.add_task("t" + std::to_string(cell), grid_.position(cell),
                       std::vector<std::string>{"a"});
    return std::move(builder).build();
  }
  Path random_walk() {
    Path path = testing::random_walk(grid_, random_, 24);
    while (path.size() > 1 && path.back() == path[path.size() - 2]) path.pop_back();
    return path;
  }

  // Finds `expected` with constraints and `path` with reservations. Both must have the same
  // outcome.
  template <class Goals, class Search>
  Outcome find_both(Goals& goals, Search& search, const ReservationTable& reservations,
                    const std::vector<Path>& walks, Path& expected, Path& path) {
    std::vector<Constraint> constraints;
    for (const Path& walk : walks) bar(walk, constraints);
    const Outcome outcome = search.find(goals, {constraints}, Limits(), expected);
    const PathQuery query{.reservations = &reservations};
    const Outcome same = search.find(goals, query, Limits(), path);
    EXPECT_EQ(same, outcome);
    return same == outcome ? outcome : Outcome::kStopped;
  }

  void compare(SequenceStages& goals, FreeOrderSipp& search, const ReservationTable& reservations,
               const std::vector<Path>& walks) {
    ++compared;
    Path expected;
    Path path;
    const Limits limits;
    const Outcome outcome = find_both(goals, search, reservations, walks, expected, path);
    if (outcome != Outcome::kFound) {
      const PathQuery query{
          .cutoff = below(40), .reservations = &reservations, .inflation_percent = below(3) * 50};
      EXPECT_NE(search.find(goals, query, limits, path), Outcome::kFound);
      return;
    }
    ++found;
    EXPECT_EQ(path.size(), expected.size());
    expect_valid(goals, path, walks);
    const Time cost = static_cast<Time>(expected.size()) - 1;
    for (const int inflation : {0, 30, 200}) {
      PathQuery query{
          .cutoff = cost - 1, .reservations = &reservations, .inflation_percent = inflation};
      EXPECT_EQ(search.find(goals, query, limits, path), Outcome::kAboveCutoff);
      query.cutoff = cost + below(10);
      ASSERT_EQ(search.find(goals, query, limits, path), Outcome::kFound);
      EXPECT_LE(static_cast<Time>(path.size()) - 1, inflation == 0 ? cost : query.cutoff);
      expect_valid(goals, path, walks);
    }
    const PathQuery inflated{.reservations = &reservations, .inflation_percent = 200};
    ASSERT_EQ(search.find(goals, inflated, limits, path), Outcome::kFound);
    expect_valid(goals, path, walks);
  }

  GoalSequence random_order(const DistanceFields& distances) {
    std::vector<TaskIndex> stops = instance_.agent(0).stops;
    std::ranges::shuffle(stops, random_);
    return {instance_, distances, 0, stops};
  }

  void compare(const GoalSequence& goals, FixedOrderSipp& search,
               const ReservationTable& reservations, const std::vector<Path>& walks) {
    Path expected;
    Path path;
    const Limits limits;
    const Outcome outcome = find_both(goals, search, reservations, walks, expected, path);
    PathQuery query{.cutoff = below(40), .reservations = &reservations};
    if (outcome != Outcome::kFound) {
      EXPECT_NE(search.find(goals, query, limits, path), Outcome::kFound);
      return;
    }
    EXPECT_EQ(path.size(), expected.size());
    expect_valid(path, walks);
    const Time cost = static_cast<Time>(expected.size()) - 1;
    query.cutoff = cost - 1;
    EXPECT_EQ(search.find(goals, query, limits, path), Outcome::kAboveCutoff);
    query.cutoff = cost + below(10);
    ASSERT_EQ(search.find(goals, query, limits, path), Outcome::kFound);
    EXPECT_EQ(path.size(), expected.size());
    expect_valid(path, walks);
  }

  void expect_valid(const SequenceStages& goals, const Path& path, const std::vector<Path>& walks) {
    EXPECT_NO_THROW(realized_sequence(goals, path));
    expect_valid(path, walks);
  }
  void expect_valid(const Path& path, const std::vector<Path>& walks) {
    EXPECT_EQ(path[0], instance_.agent(0).start);
    for (std::size_t t = 1; t < path.size(); ++t)
      EXPECT_TRUE(path[t] == path[t - 1] ||
                  std::ranges::count(grid_.neighbors(path[t - 1]), path[t]) == 1);
    for (const Path& walk : walks) EXPECT_FALSE(collide(path, walk));
  }

  std::mt19937 random_;
  Grid grid_;
  Instance instance_;
  std::vector<AgentIndex> names_;
  AgentIndex next_name_ = 0;
};

TEST(ReservationTable, SearchAgreesWithEquivalentConstraints) {
  const int seeds = testing::fuzz_rounds(1500);
  int compared = 0;
  int found = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fuzzer fuzzer(static_cast<unsigned>(seed));
    fuzzer.check();
    if (HasFailure()) return;
    compared += fuzzer.compared;
    found += fuzzer.found;
  }
  EXPECT_EQ(compared, 12 * seeds);
  EXPECT_GT(found, compared / 5);
  EXPECT_LT(found, compared * 4 / 5);
}

TEST(ReservationTable, LabelLimitStopsTheSearch) {
  const Instance instance =
      testing::instance_of({std::string(60, '.'), std::string(60, '.'), std::string(60, '.')},
                           {{{0, 0}, Position{59, 2}, {{30, 0}, {2, 2}, {50, 1}, {20, 1}}}});
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages goals(stops, {});
  ReservationTable reservations(instance.grid());
  Path late(300, 30);  // the other agent stays on a task for a long time
  late.push_back(31);
  reservations.add(1, late);
  FreeOrderSipp search(instance.grid());
  Path path;
  PathQuery query{.label_limit = 500, .reservations = &reservations};
  EXPECT_EQ(search.find(goals, query, Limits(), path), Outcome::kStopped);
  EXPECT_LT(search.expanded(), 1000);
  query.label_limit = PathQuery::kUnlimited;
  EXPECT_EQ(search.find(goals, query, Limits(), path), Outcome::kFound);
  EXPECT_GE(path.size(), 300u);
}

}  // namespace reservation_table_test
}  // namespace grove::detail
