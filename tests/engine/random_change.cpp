// SPDX-License-Identifier: MIT
#include "tests/engine/random_change.h"

#include <fmt/format.h>

#include <algorithm>

namespace grove::detail::testing {
namespace {

constexpr Time kMaxDelay = 12;

Place random_place(const Instance& instance, Random& random) {
  if (const Roadmap* roadmap = instance.roadmap())
    return roadmap->place_of_vertex(static_cast<int>(random.below(roadmap->vertices().size())));
  const Grid& grid = instance.grid();
  for (;;) {
    const Cell cell = random.below(grid.cell_count());
    if (grid.passable(cell)) return cell;
  }
}

NewTask random_task(const Instance& instance, Random& random) {
  NewTask task{fmt::format("new{}", random.below(1'000'000)), random_place(instance, random), {}};
  task.agents.push_back(instance.agent(random.below(instance.agent_count())).id);
  if (random.below(4) == 0) task.duration = static_cast<Time>(1 + random.below(3));
  return task;
}

}  // namespace

std::vector<Delay> random_delays(const Instance& instance, Time time, Random& random) {
  std::vector<Delay> late;
  if (time == 0) return late;
  for (int i = random.below(3); i > 0; --i) {
    const AgentIndex agent = random.below(instance.agent_count());
    if (late.empty() || late.front().agent != agent)
      late.push_back({agent, static_cast<Time>(1 + random.below(std::min(kMaxDelay, time)))});
  }
  return late;
}

InstanceChange random_change(const Instance& instance, Random& random) {
  InstanceChange change;
  const int kinds = 1 + random.below(7);
  if (kinds & 1) change.new_tasks.push_back(random_task(instance, random));
  if ((kinds & 2) && instance.task_count() > 0)
    change.dropped_tasks.push_back(instance.task(random.below(instance.task_count())).id);
  if (kinds & 4) {
    const Roadmap* roadmap = instance.roadmap();
    if (roadmap && !roadmap->roads().empty() && random.below(2) == 0)
      change.closed_roads.push_back(static_cast<int>(random.below(roadmap->roads().size())));
    else
      change.blocked.push_back(random_place(instance, random));
  }
  return change;
}

}  // namespace grove::detail::testing
