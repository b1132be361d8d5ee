// SPDX-License-Identifier: MIT
#include "tests/execution/collisions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace grove::detail::testing {
namespace {

struct Stay {
  AgentIndex agent;
  Time enters_begin;  // start of the move onto the place; negative if the robot starts there
  Time enters_end;
  Time leaves_begin = kNever;
  Time leaves_end = kNever;
  Place came_from = kNoPlace;
  Place goes_to = kNoPlace;
};

std::map<Place, std::vector<Stay>> stays_of(const World& world, const ActionDependencyGraph& order,
                                            const ExecutionTrace& trace,
                                            const std::vector<State>& starts) {
  std::map<Place, std::vector<Stay>> stays;
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    Stay stay{agent, -2, -1};
    Place at = world.place(starts[agent]);
    for (ActionIndex a = order.begin_of(agent); a < order.end_of(agent); ++a) {
      const Action& action = order.actions()[a];
      if (action.kind != Action::Kind::kMove || trace.begin[a] == kNever) continue;
      stay.leaves_begin = trace.begin[a];
      stay.leaves_end = trace.end[a];
      stay.goes_to = world.place(action.to);
      stays[at].push_back(stay);
      stay = {agent, trace.begin[a], trace.end[a]};
      stay.came_from = std::exchange(at, world.place(action.to));
    }
    stays[at].push_back(stay);
  }
  return stays;
}

bool follows(const Stay& first, const Stay& next) {
  return next.enters_begin == first.leaves_begin && next.enters_end == first.leaves_end &&
         first.goes_to != next.came_from;
}

}  // namespace

std::string collision(const World& world, const ActionDependencyGraph& order,
                      const ExecutionTrace& trace, const std::vector<State>& starts) {
  for (auto& [place, row] : stays_of(world, order, trace, starts)) {
    std::ranges::sort(row, {}, &Stay::enters_begin);
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (row[i].enters_begin >= row[i - 1].leaves_end || follows(row[i - 1], row[i])) continue;
      return fmt::format("agents {} and {} on place {} at {}", row[i - 1].agent, row[i].agent,
                         place, row[i].enters_begin);
    }
  }
  return "";
}

}  // namespace grove::detail::testing
