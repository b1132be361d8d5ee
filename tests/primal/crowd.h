// SPDX-License-Identifier: MIT
// Random dense instances on medium-sized maps.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "model/distance_field.h"
#include "model/instance.h"
#include "tests/fuzz/random.h"

namespace grove::detail::testing {

struct Crowd {
  int size = 12;       // side of the square map in cells
  int obstacles = 15;  // percent
  int agents = 20;
  int tasks = 20;
  int no_destination = 0;  // percent of the agents

  // GoogleTest prints this text in test names.
  friend void PrintTo(const Crowd& crowd, std::ostream* out) {
    *out << fmt::format("{} agents, {} tasks, size {}, {} % obstacles, {} % without destination",
                        crowd.agents, crowd.tasks, crowd.size, crowd.obstacles,
                        crowd.no_destination);
  }
};

// Returns the cells of the largest connected component.
inline std::vector<Cell> largest_part(const Grid& grid) {
  std::vector<Cell> largest;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
    if (!grid.passable(cell)) continue;
    const DistanceField field = distance_field(grid, cell);
    std::vector<Cell> part;
    for (Cell other = 0; other < grid.cell_count(); ++other)
      if (field[other] < kNever) part.push_back(other);
    if (part.size() > largest.size()) largest = part;
  }
  return largest;
}

// Returns an instance in which agents start and end on distinct random cells of one connected
// component. An agent without a destination has a task on its end cell. All other tasks, each for
// one or two agents, are on cells that are not such an end cell.
inline Instance random_crowd(const Crowd& crowd, std::uint64_t seed) {
  fuzz::Random random(seed);
  std::vector<bool> passable;
  for (int i = 0; i < crowd.size * crowd.size; ++i)
    passable.push_back(!random.percent(crowd.obstacles));
  const Grid grid(crowd.size, crowd.size, passable);
  std::vector<Cell> starts = largest_part(grid);
  std::vector<Cell> ends = starts;
  random.shuffle(starts);
  random.shuffle(ends);

  InstanceBuilder builder(grid);
  const auto id = [](const char* kind, int i) { return fmt::format("{}{}", kind, i); };
  std::vector<Cell> elsewhere(ends.begin() + crowd.agents, ends.end());
  std::vector<int> without;
  for (int i = 0; i < crowd.agents; ++i) {
    std::optional<Position> destination;
    if (random.percent(crowd.no_destination)) {
      without.push_back(i);
    } else {
      destination = grid.position(ends[i]);
      elsewhere.push_back(ends[i]);
    }
    builder.add_agent(id("a", i), grid.position(starts[i]), destination);
  }
  for (int i : without)
    builder.add_task(id("end", i), grid.position(ends[i]), std::vector{id("a", i)});
  random.shuffle(elsewhere);
  for (int t = 0; t < crowd.tasks; ++t) {
    const int first = random.below(crowd.agents);
    const int second = random.below(crowd.agents);
    std::vector<std::string> visitors{id("a", first)};
    if (second != first) visitors.push_back(id("a", second));
    builder.add_task(id("t", t), grid.position(elsewhere[t]), visitors);
  }
  return std::move(builder).build();
}

}  // namespace grove::detail::testing
