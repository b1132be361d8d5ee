// SPDX-License-Identifier: MIT
#include "tests/oracle/steps.h"

#include <algorithm>
#include <variant>

namespace grove::oracle {
namespace {

std::vector<std::vector<Place>> steps(const Grid& grid) {
  std::vector<std::vector<Place>> steps(static_cast<std::size_t>(grid.cell_count()));
  const auto is_open = [&](Position p) { return grid.contains(p) && grid.passable(grid.cell(p)); };
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x)
      for (const Position to :
           {Position{x - 1, y}, Position{x + 1, y}, Position{x, y - 1}, Position{x, y + 1}})
        if (is_open({x, y}) && is_open(to)) steps[grid.cell({x, y})].push_back(grid.cell(to));
  return steps;
}

std::vector<std::vector<Place>> steps(const Roadmap& roadmap) {
  std::vector<std::vector<Place>> steps(static_cast<std::size_t>(roadmap.place_count()));
  const auto add = [&](Place from, Place to) {
    if (from != to && std::ranges::count(steps[from], to) == 0) steps[from].push_back(to);
  };
  for (std::size_t r = 0; r < roadmap.roads().size(); ++r) {
    const Road& road = roadmap.roads()[r];
    std::vector<Place> along{road.from};
    for (Time k = 1; k < road.steps; ++k)
      along.push_back(roadmap.place_on_road(static_cast<int>(r), k));
    along.push_back(road.to);
    for (std::size_t i = 1; i < along.size(); ++i) {
      add(along[i - 1], along[i]);
      if (!road.one_way) add(along[i], along[i - 1]);
    }
  }
  return steps;
}

}  // namespace

std::vector<std::vector<Place>> steps_on(const Map& map) {
  return std::visit([](const auto& m) { return steps(m); }, map);
}

}  // namespace grove::oracle
