// SPDX-License-Identifier: MIT
// Occupancy of places over time, and collisions, of one path per agent.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// A collision of two agents: both are on one place, or they swap places.
struct Collision {
  AgentIndex a;
  AgentIndex b;
  Time time;     // when both are on the place, or arrive by the swap
  Place place;   // the place, or the place to which `a` moves
  Place before;  // the place from which `a` moves, if it is a swap; else kNoPlace
};

// Counts agents by place and time until all are at rest. Agents at rest count. One thread at a
// time.
class OccupancyCounts {
 public:
  // `world` must outlive this.
  explicit OccupancyCounts(const World& world) : world_(world) {}

  // Replaces the counts. `paths`, by agent, empty for an agent without one, must stay unchanged
  // while this is used.
  void count(std::span<const Path> paths);

  // All agents are at rest from this time on.
  Time end() const { return end_; }
  int at(Place place, Time time) const {
    return time < end_ ? counts_[index(place, time)] : counts_[index(place, end_ - 1)];
  }
  // At each time from 1 on: for each place with several agents, each agent but the first paired
  // with the previous one; and all swaps. The order depends only on the paths.
  std::vector<Collision> collisions() const;

 private:
  std::size_t index(Place place, Time time) const {
    return static_cast<std::size_t>(time) * static_cast<std::size_t>(world_.place_count()) +
           static_cast<std::size_t>(place);
  }

  const World& world_;
  std::span<const Path> paths_;
  Time end_ = 1;
  std::vector<std::uint16_t> counts_;  // by time, then place
};

}  // namespace grove::detail
