// SPDX-License-Identifier: MIT
#include "tests/planning/single_agent.h"

#include <fmt/format.h>

#include <numeric>

namespace grove::detail::testing {
namespace {

Instance instance_of(const Grid& grid, Cell start, const std::vector<Cell>& tasks,
                     std::optional<Cell> destination) {
  InstanceBuilder builder(grid);
  std::optional<Position> goal;
  if (destination) goal = grid.position(*destination);
  builder.add_agent("a", grid.position(start), goal);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    builder.add_task(fmt::format("t{}", k), grid.position(tasks[k]), std::vector<std::string>{"a"});
  return std::move(builder).build();
}

std::vector<TaskIndex> all_tasks(const Instance& instance) {
  std::vector<TaskIndex> tasks(instance.task_count());
  std::iota(tasks.begin(), tasks.end(), 0);
  return tasks;
}

}  // namespace

SingleAgent::SingleAgent(const Grid& grid, Cell start, const std::vector<Cell>& tasks,
                         std::optional<Cell> destination)
    : instance(instance_of(grid, start, tasks, destination)),
      distances(instance),
      goals(instance, distances, 0, all_tasks(instance)) {}

}  // namespace grove::detail::testing
