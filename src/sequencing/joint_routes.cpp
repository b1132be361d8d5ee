// SPDX-License-Identifier: MIT
#include "sequencing/joint_routes.h"

#include <algorithm>

namespace grove::detail {

// By end, then by the stops. (GCC 12 warns of the default for vectors of bytes.)
std::strong_ordering operator<=>(const AgentRoute& a, const AgentRoute& b) {
  if (a.end != b.end) return a.end <=> b.end;
  const auto [in_a, in_b] = std::ranges::mismatch(a.stops, b.stops);
  if (in_a == a.stops.end() || in_b == b.stops.end()) return a.stops.size() <=> b.stops.size();
  return *in_a <=> *in_b;
}

StopSet stops_of(const Sequence& sequence) {
  StopSet set = 0;
  for (const Stop stop : sequence) set |= bit(stop);
  return set;
}

bool may_end(const AgentRoutes& agent, const RouteEnd& end, StopSet visited) {
  return (agent.required & ~visited) == 0 && (end.any_of == 0 || (visited & end.any_of) != 0);
}

Time legs_cost(const AgentRoutes& agent, const Sequence& stops) {
  Time cost = 0;
  int last = agent.stops();
  for (const Stop stop : stops) {
    cost = add_costs(cost, agent.legs(last, stop));
    last = stop;
  }
  return cost;
}

Time route_cost(const AgentRoutes& agent, const AgentRoute& route) {
  const RouteEnd& end = agent.ends[static_cast<std::size_t>(route.end)];
  if (!may_end(agent, end, stops_of(route.stops))) return kNever;
  const int last = route.stops.empty() ? agent.stops() : route.stops.back();
  return add_costs(legs_cost(agent, route.stops), end_cost(agent, end, last));
}

}  // namespace grove::detail
