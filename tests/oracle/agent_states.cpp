// SPDX-License-Identifier: MIT
#include "tests/oracle/agent_states.h"

#include <algorithm>
#include <variant>

#include "tests/oracle/steps.h"

namespace grove::oracle {
namespace {

constexpr std::size_t kMaxStates = std::size_t{1} << 22;

}  // namespace

bool AgentStates::fits(const Instance& instance, AgentIndex agent) {
  const std::size_t tasks = instance.agent(agent).tasks.size();
  return tasks < 20 &&
         (static_cast<std::size_t>(instance.world().place_count()) << tasks) * 2 <= kMaxStates;
}

AgentStates::AgentStates(const Instance& instance, AgentIndex agent)
    : goal_(instance.agent(agent).goal) {
  const auto* grid = std::get_if<Grid>(&instance.map());
  for (Place p = 0; p < instance.world().place_count(); ++p)
    if (!grid || grid->passable(p)) passable_.push_back(p);
  for (TaskIndex task : instance.agent(agent).tasks)
    task_cells_.push_back(instance.task(task).cell);
  const Place start = instance.agent(agent).start;
  start_ =
      state(std::ranges::lower_bound(passable_, start) - passable_.begin(), visit(0, start), false);
  connect(instance.map());
  settle_costs();
}

AgentStates::State AgentStates::state(std::size_t cell_index, std::uint64_t visited,
                                      bool resting) const {
  return static_cast<State>((visited * passable_.size() + cell_index) * 2 + (resting ? 1 : 0));
}

std::uint64_t AgentStates::visit(std::uint64_t visited, Place cell) const {
  for (std::size_t k = 0; k < task_cells_.size(); ++k)
    if (task_cells_[k] == cell) visited |= std::uint64_t{1} << k;
  return visited;
}

bool AgentStates::may_rest(Place cell, std::uint64_t visited) const {
  if (visited != (std::uint64_t{1} << task_cells_.size()) - 1) return false;
  return goal_ ? cell == *goal_ : std::ranges::count(task_cells_, cell) > 0;
}

void AgentStates::connect(const Map& map) {
  const auto steps = steps_on(map);
  std::vector<std::size_t> index(steps.size());
  for (std::size_t i = 0; i < passable_.size(); ++i) index[passable_[i]] = i;
  moves_.resize((passable_.size() << task_cells_.size()) * 2);
  for (State s = 0; s < count(); ++s) {
    const auto here = index[cell(s)];
    if (resting(s)) {
      moves_[s].push_back({s, 0});
      continue;
    }
    if (may_rest(cell(s), visited(s))) moves_[s].push_back({state(here, visited(s), true), 0});
    moves_[s].push_back({s, 1});
    for (Place next : steps[cell(s)])
      moves_[s].push_back({state(index[next], visit(visited(s), next), false), 1});
  }
}

// Sweeps until nothing changes: slow and hard to get wrong.
void AgentStates::settle_costs() {
  to_go_.assign(moves_.size(), kNever);
  for (State s = 0; s < count(); ++s)
    if (resting(s) || may_rest(cell(s), visited(s))) to_go_[s] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (State s = count() - 1; s >= 0; --s) {
      for (const Move& move : moves_[s]) {
        if (to_go_[move.to] == kNever || to_go_[move.to] + move.cost >= to_go_[s]) continue;
        to_go_[s] = to_go_[move.to] + move.cost;
        changed = true;
      }
    }
  }
}

}  // namespace grove::oracle
