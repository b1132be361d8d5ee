// SPDX-License-Identifier: MIT
// Reservation table: the paths of agents that are already planned, which other agents must not
// collide with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Stores the paths of some agents by place, including their final rest. Prioritised planning treats
// them as moving obstacles. Adding or removing a path takes, for each of its stays, time linear in
// the number of stays on the same place. The low level looks up only the places that it reaches.
// One thread at a time.
class ReservationTable {
 public:
  static constexpr AgentIndex kNoAgent = -1;

  // A period during which an agent is on a place without a break.
  struct Stay {
    Time first;        // time of arrival
    Time last;         // last time there, inclusive; kNever: final rest
    Place next;        // its place at time last + 1; kNoPlace for a final rest
    AgentIndex agent;  // the agent that stays
  };

  // `world` must outlive this object. A place also counts as occupied for `margin` steps before and
  // after each stay.
  explicit ReservationTable(const World& world, Time margin = 0)
      : world_(world), margin_(margin), stays_(world.place_count()) {}

  Time margin() const { return margin_; }

  // `path` must not be empty and must not collide with a path in the table. An agent has at most
  // one path.
  void add(AgentIndex agent, const Path& path);
  // `path` must have been added for this agent.
  void remove(AgentIndex agent, const Path& path);
  void clear();

  // The stays on a place, in order of time, without overlap.
  std::span<const Stay> stays(Place place) const { return stays_[place]; }
  // Number of stays on all places.
  std::int64_t count() const { return count_; }
  // The agent on the place at this time, without margin; kNoAgent if there is none.
  AgentIndex agent_at(Place place, Time time) const;

  // May an agent that is not in the table be on `to` at time `arrival`, coming from the neighbor
  // `from`, or by a wait if `from` == `to`?
  bool may_arrive(Place from, Place to, Time arrival) const;
  // May an agent that is not in the table rest on the place forever from time `from` on?
  bool may_rest_from(Place place, Time from) const {
    return stays_[place].empty() || std::int64_t{stays_[place].back().last} + margin_ < from;
  }

 private:
  const World& world_;
  const Time margin_;
  std::vector<std::vector<Stay>> stays_;  // by place
  std::int64_t count_ = 0;
};

}  // namespace grove::detail
