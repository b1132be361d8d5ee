// SPDX-License-Identifier: MIT
#include "grove/planning/reservations.h"

#include <algorithm>

#include "grove/model/assert.h"

namespace grove {
namespace {

// Calls see(cell, stay) for each stay of a path.
template <class See>
void for_each_stay(AgentIndex agent, const Path& path, See see) {
  const auto end = static_cast<Time>(path.size());
  for (Time first = 0; first < end;) {
    Time after = first + 1;
    while (after < end && path[after] == path[first]) ++after;
    if (after < end)
      see(path[first], Reservations::Stay{first, after - 1, path[after], agent});
    else
      see(path[first], Reservations::Stay{first, kNever, kNoCell, agent});
    first = after;
  }
}

}  // namespace

void Reservations::add(AgentIndex agent, const Path& path) {
  for_each_stay(agent, path, [this](Cell cell, const Stay& stay) {
    std::vector<Stay>& stays = stays_[cell];
    const auto after = std::ranges::upper_bound(stays, stay.first, {}, &Stay::first);
    GROVE_ASSERT(after == stays.end() || stay.last < after->first, "reserved paths do not collide");
    GROVE_ASSERT(after == stays.begin() || std::prev(after)->last < stay.first,
                 "reserved paths do not collide");
    stays.insert(after, stay);
    ++count_;
  });
}

void Reservations::remove(AgentIndex agent, const Path& path) {
  for_each_stay(agent, path, [this, agent](Cell cell, const Stay& stay) {
    std::vector<Stay>& stays = stays_[cell];
    const auto at = std::ranges::lower_bound(stays, stay.first, {}, &Stay::first);
    GROVE_ASSERT(at != stays.end() && at->first == stay.first && at->agent == agent,
                 "a path that goes was reserved");
    stays.erase(at);
    --count_;
  });
}

void Reservations::clear() {
  for (std::vector<Stay>& stays : stays_) stays.clear();
  count_ = 0;
}

AgentIndex Reservations::agent_at(Cell cell, Time time) const {
  const std::vector<Stay>& stays = stays_[cell];
  const auto after = std::ranges::upper_bound(stays, time, {}, &Stay::first);
  if (after == stays.begin() || std::prev(after)->last < time) return kNobody;
  return std::prev(after)->agent;
}

}  // namespace grove
