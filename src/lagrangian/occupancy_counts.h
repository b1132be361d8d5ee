// SPDX-License-Identifier: MIT
// Who is where when, and who is in whose way, if every agent has a path of its own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Two agents that collide.
struct Collision {
  AgentIndex a;
  AgentIndex b;
  Time time;     // they are on one place then, or arrive by a swap
  Place place;   // that place, or that to which `a` moves
  Place before;  // that which `a` moves from, if it is a swap; else kNoPlace
};

// Counts agents by place and time, those at rest included, up to the time when all rest. For one
// thread at a time.
class OccupancyCounts {
 public:
  // `world` must outlive this.
  explicit OccupancyCounts(const World& world) : world_(world) {}

  // Replaces what was counted. `paths` by agent, empty for who has none, must stay as they are.
  void count(std::span<const Path> paths);

  // Everybody is at rest from then on.
  Time end() const { return end_; }
  int at(Place place, Time time) const {
    return time < end_ ? counts_[index(place, time)] : counts_[index(place, end_ - 1)];
  }
  // Of each place with several agents each but the first with one before, and all swaps; in an
  // order that the paths alone settle.
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
