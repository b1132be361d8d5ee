// SPDX-License-Identifier: MIT
// Counts agents by place and time, and finds collisions, for one path per agent.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// A collision of two agents, which are on one place or swap places.
struct Collision {
  AgentIndex a;
  AgentIndex b;
  Time time;     // at which both are on the place, or complete the swap
  Place place;   // the place, or the place to which `a` moves
  Place before;  // for a swap: the place from which `a` moves; else kNoPlace
};

// The number of agents on each place at each time, including agents at rest. One thread at a time.
class OccupancyCounts {
 public:
  // `world` must outlive this object.
  explicit OccupancyCounts(const World& world) : world_(world) {}

  // Replaces the counts by those of `paths`, which has one path per agent; an empty path is not
  // counted. `paths` must remain unchanged until the last call of collisions().
  void count(std::span<const Path> paths);

  // A time >= 1 from which all agents are at rest: the maximum number of states of a path.
  Time end() const { return end_; }
  int at(Place place, Time time) const {
    return time < end_ ? counts_[index(place, time)] : counts_[index(place, end_ - 1)];
  }
  // The collisions at each time >= 1. On a place with several agents, each agent except the first
  // forms a collision with the agent of the next lower index there. An agent that swaps places with
  // agents of lower index forms a collision with the lowest of these. The order of the result
  // depends only on the paths.
  std::vector<Collision> collisions() const;

 private:
  std::size_t index(Place place, Time time) const {
    return static_cast<std::size_t>(time) * static_cast<std::size_t>(world_.place_count()) +
           static_cast<std::size_t>(place);
  }

  const World& world_;
  std::span<const Path> paths_;
  Time end_ = 1;
  std::vector<std::uint16_t> counts_;  // by time and place
};

}  // namespace grove::detail
