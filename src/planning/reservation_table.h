// SPDX-License-Identifier: MIT
// Where planned agents are: what a further one must plan around.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// The whole paths of some agents and their resting for ever, by place: prioritised planning takes
// them for walls. Adding or removing a path costs what is on its places, and the low level looks up
// only the places it comes to. For one thread.
class ReservationTable {
 public:
  static constexpr AgentIndex kNobody = -1;

  // An agent's being on a place without a break.
  struct Stay {
    Time first;        // from here
    Time last;         // to here, inclusive; kNever: it rests there
    Place next;        // where it moves at last + 1; kNoPlace when it rests
    AgentIndex agent;  // whose it is
  };

  // `world` must outlive this. `margin`: a place is taken so many steps before and after anybody is
  // there.
  explicit ReservationTable(const World& world, Time margin = 0)
      : world_(world), margin_(margin), stays_(world.place_count()) {}

  Time margin() const { return margin_; }

  // `path`, not empty, must collide with no path that is here; an agent has at most one.
  void add(AgentIndex agent, const Path& path);
  // `path` must have been added for this agent.
  void remove(AgentIndex agent, const Path& path);
  void clear();

  // The stays on a place in order of time; they do not overlap.
  std::span<const Stay> stays(Place place) const { return stays_[place]; }
  // How many there are on all places.
  std::int64_t count() const { return count_; }
  // Who is on the place at this time; kNobody.
  AgentIndex agent_at(Place place, Time time) const;

  // May another one arrive then, from a neighbour or from the place itself, on which it is?
  bool lets_arrive(Place from, Place to, Time arrival) const;
  // May it rest there from then on?
  bool lets_rest(Place place, Time from) const {
    return stays_[place].empty() || std::int64_t{stays_[place].back().last} + margin_ < from;
  }

 private:
  const World& world_;
  const Time margin_;
  std::vector<std::vector<Stay>> stays_;  // by place
  std::int64_t count_ = 0;
};

}  // namespace grove::detail
