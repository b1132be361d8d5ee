// SPDX-License-Identifier: MIT
// Reservation table: the paths of planned agents, which a further agent must avoid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// The whole paths of some agents, including their rest for ever, by place. Prioritised planning
// treats them as obstacles. Adding or removing a path costs time in the number of stays on its
// places, and the low level looks up only the places that it reaches. One thread at a time.
class ReservationTable {
 public:
  static constexpr AgentIndex kNoAgent = -1;

  // A period during which an agent is on a place without a break.
  struct Stay {
    Time first;        // time of arrival
    Time last;         // last time there, inclusive; kNever: it rests there
    Place next;        // its place at last + 1; kNoPlace if it rests
    AgentIndex agent;  // the agent that stays
  };

  // `world` must outlive this. A place counts as occupied also `margin` steps before and after an
  // agent is there.
  explicit ReservationTable(const World& world, Time margin = 0)
      : world_(world), margin_(margin), stays_(world.place_count()) {}

  Time margin() const { return margin_; }

  // `path` must not be empty and must not collide with a path in the table. An agent has at most
  // one path.
  void add(AgentIndex agent, const Path& path);
  // `path` must have been added for this agent.
  void remove(AgentIndex agent, const Path& path);
  void clear();

  // The stays on a place in order of time; they do not overlap.
  std::span<const Stay> stays(Place place) const { return stays_[place]; }
  // Number of stays on all places.
  std::int64_t count() const { return count_; }
  // The agent on the place at this time; kNoAgent if there is none.
  AgentIndex agent_at(Place place, Time time) const;

  // May another agent arrive on `to` at `arrival`, from a neighbour or, if `from` == `to`, by
  // waiting there?
  bool may_arrive(Place from, Place to, Time arrival) const;
  // May another agent rest on the place from `from` on?
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
