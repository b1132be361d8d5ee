// SPDX-License-Identifier: MIT
// Agents that block a path: those with which it would collide.
#pragma once

#include "planning/reservation_table.h"

namespace grove::detail {

// Calls visit(other) for each planned agent, other than `agent`, with which `agent` would collide
// on `path` begun `late` steps late, resting at its end included. An agent may be visited more than
// once. Stops when visit() returns false.
template <class Visit>
void for_each_blocking_agent(const World& world, const ReservationTable& reservations,
                             AgentIndex agent, const Path& path, Time late, Visit visit) {
  const auto ends_at = [&](AgentIndex other) {
    return other != ReservationTable::kNobody && other != agent && !visit(other);
  };
  const Time margin = reservations.margin();
  for (Time t = 1; t < static_cast<Time>(path.size()); ++t) {
    const Place from = world.place(path[t - 1]);
    const Place to = world.place(path[t]);
    for (Time at = t + late - margin; at <= t + late + margin; ++at)
      if (ends_at(reservations.agent_at(to, at))) return;
    const AgentIndex before = reservations.agent_at(to, t + late - 1);
    const bool swaps = from != to && before == reservations.agent_at(from, t + late);
    if (swaps && ends_at(before)) return;
  }
  const Time end = static_cast<Time>(path.size()) - 1 + late;
  for (const ReservationTable::Stay& stay : reservations.stays(world.place(path.back())))
    if (stay.last >= end - margin && ends_at(stay.agent)) return;
}

}  // namespace grove::detail
