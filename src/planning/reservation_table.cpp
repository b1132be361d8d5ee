// SPDX-License-Identifier: MIT
#include "planning/reservation_table.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

// Calls function(place, stay) for each stay of a path.
template <class Function>
void for_each_stay(const World& world, AgentIndex agent, const Path& path, Function function) {
  const auto end = static_cast<Time>(path.size());
  for (Time first = 0; first < end;) {
    const Place place = world.place(path[first]);
    Time after = first + 1;
    while (after < end && world.place(path[after]) == place) ++after;
    if (after < end)
      function(place, ReservationTable::Stay{first, after - 1, world.place(path[after]), agent});
    else
      function(place, ReservationTable::Stay{first, kNever, kNoPlace, agent});
    first = after;
  }
}

}  // namespace

void ReservationTable::add(AgentIndex agent, const Path& path) {
  for_each_stay(world_, agent, path, [this](Place place, const Stay& stay) {
    std::vector<Stay>& stays = stays_[place];
    const auto after = std::ranges::upper_bound(stays, stay.first, {}, &Stay::first);
    GROVE_ASSERT(after == stays.end() || stay.last < after->first, "reserved paths do not collide");
    GROVE_ASSERT(after == stays.begin() || std::prev(after)->last < stay.first,
                 "reserved paths do not collide");
    stays.insert(after, stay);
    ++count_;
  });
}

void ReservationTable::remove(AgentIndex agent, const Path& path) {
  for_each_stay(world_, agent, path, [this, agent](Place place, const Stay& stay) {
    std::vector<Stay>& stays = stays_[place];
    const auto at = std::ranges::lower_bound(stays, stay.first, {}, &Stay::first);
    GROVE_ASSERT(at != stays.end() && at->first == stay.first && at->agent == agent,
                 "only a reserved path is removed");
    stays.erase(at);
    --count_;
  });
}

void ReservationTable::clear() {
  for (std::vector<Stay>& stays : stays_) stays.clear();
  count_ = 0;
}

AgentIndex ReservationTable::agent_at(Place place, Time time) const {
  const std::vector<Stay>& stays = stays_[place];
  const auto after = std::ranges::upper_bound(stays, time, {}, &Stay::first);
  if (after == stays.begin() || std::prev(after)->last < time) return kNoAgent;
  return std::prev(after)->agent;
}

bool ReservationTable::may_arrive(Place from, Place to, Time arrival) const {
  const std::vector<Stay>& stays = stays_[to];
  const auto after = std::ranges::upper_bound(stays, arrival + margin_, {}, &Stay::first);
  if (after == stays.begin()) return true;
  const Stay& stay = *std::prev(after);
  if (stay.last >= arrival - margin_) return false;
  const bool swaps = stay.last == arrival - 1 && stay.next == from;
  return !swaps;
}

}  // namespace grove::detail
