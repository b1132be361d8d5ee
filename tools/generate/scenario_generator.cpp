// SPDX-License-Identifier: MIT
#include "tools/generate/scenario_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/input_error.h"
#include "model/distance_field.h"
#include "tools/generate/components.h"
#include "tools/generate/random.h"

namespace grove::detail {

std::vector<ScenarioRow> random_scenario(const Grid& grid, const std::string& map, int count,
                                         std::uint64_t seed, const std::string& purpose) {
  std::vector<Cell> starts = largest_component(grid);
  if (starts.size() < static_cast<std::size_t>(std::max(count, 2)))
    throw InputError(map, "",
                     fmt::format("has {} connected passable cells; expected at least {} for {}",
                                 starts.size(), std::max(count, 2), purpose));
  std::vector<Cell> goals = starts;
  Random random = random_for(RandomUse::kScenario, seed);
  random.shuffle(starts);
  random.shuffle(goals);
  // If the goal of a row is its start, swaps it with the next row's goal. Afterwards both goals
  // differ from the starts of their rows, because starts are distinct and goals are distinct.
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (goals[k] == starts[k]) std::swap(goals[k], goals[(k + 1) % goals.size()]);

  std::vector<ScenarioRow> rows;
  for (int k = 0; k < count; ++k)
    rows.push_back({.line = k + 2,
                    .map = std::filesystem::path(map).filename().string(),
                    .width = grid.width(),
                    .height = grid.height(),
                    .start = grid.position(starts[k]),
                    .goal = grid.position(goals[k])});
  return rows;
}

std::vector<Time> scenario_lengths(const Grid& grid, const std::vector<ScenarioRow>& rows) {
  std::vector<Time> lengths;
  for (const ScenarioRow& row : rows)
    lengths.push_back(distance_field(grid, grid.cell(row.goal))[grid.cell(row.start)]);
  return lengths;
}

}  // namespace grove::detail
