// SPDX-License-Identifier: MIT
#include "model/plan_of_path.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace grove::detail {

AgentPlan plan_of_path(const Instance& instance, AgentIndex agent, const Path& path) {
  const std::vector<TaskIndex>& stops = instance.agent(agent).stops;
  std::vector<std::uint8_t> order(stops.size());
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  const bool ends_on_a_stop = instance.rests_on_last_stop(agent);
  std::ranges::stable_sort(order, {}, [&](std::uint8_t stop) {
    const auto visits = [&](State state) { return instance.is_visited(stops[stop], state); };
    const bool last = ends_on_a_stop && visits(path.back());
    return (last ? path.end() : std::ranges::find_if(path, visits)) - path.begin();
  });
  return agent_plan(instance, agent, order, path);
}

}  // namespace grove::detail
