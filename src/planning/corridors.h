// SPDX-License-Identifier: MIT
// Corridors of a world, including doors: rows of places in which an agent can only continue or turn
// round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// The corridors of a world. A corridor is a maximal row of places with exactly two neighbors, the
// *inner* places, together with the two *ends* that they join, which have fewer or more than two
// neighbors. A door between two rooms is a corridor of two moves. The two ends can be the same
// place. A ring has no end and is not a corridor. Immutable: any thread may read it.
class Corridors {
 public:
  static constexpr int kNoCorridor = -1;

  // O(places).
  explicit Corridors(const World& world);

  int count() const { return static_cast<int>(first_.size()) - 1; }
  // The corridor that contains `place` as an inner place; kNoCorridor if there is none.
  int corridor_of(Place place) const { return corridor_of_[place]; }
  // The places of a corridor: one end (the *front*), the inner places in order, the other end (the
  // *back*).
  std::span<const Place> places(int corridor) const {
    return {places_.data() + first_[corridor], places_.data() + first_[corridor + 1]};
  }
  // Index of an inner place in places(); 1 is next to the front.
  int position(Place inner) const { return position_[inner]; }

 private:
  static constexpr int kSeen = -2;  // position_ of places on a ring

  void add_corridor_through(const World& world, Place inner);
  void number_inner_places(int corridor);

  std::vector<std::int32_t> corridor_of_;  // by place
  std::vector<std::int32_t> position_;     // by place
  std::vector<Place> places_;              // corridor after corridor
  std::vector<std::int32_t> first_{0};  // by corridor: index in places_; and one more for the end
};

}  // namespace grove::detail
