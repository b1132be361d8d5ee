// SPDX-License-Identifier: MIT
// Corridors and doors: rows of places in which an agent can only go on or turn round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// The chains of a world: maximal rows of places with exactly two neighbors, the *inner* places,
// with the two *ends* they join, which have fewer or more neighbors. A door between two rooms is a
// chain of two moves. The two ends may be one place. A ring has no end and is no chain. Immutable
// after construction, so any number of threads may read one.
class Corridors {
 public:
  static constexpr int kNoCorridor = -1;

  // O(places).
  explicit Corridors(const World& world);

  int count() const { return static_cast<int>(first_.size()) - 1; }
  // Whose inner place this is; kNoCorridor if of none.
  int corridor_of(Place place) const { return corridor_of_[place]; }
  // An end, the inner places in order, the other end: the *front* and the *back*.
  std::span<const Place> places(int chain) const {
    return {places_.data() + first_[chain], places_.data() + first_[chain + 1]};
  }
  // Where an inner place is in places(): 1 is next to the front.
  int position(Place inner) const { return position_[inner]; }

 private:
  static constexpr int kSeen = -2;  // on a ring

  void add_chain_through(const World& world, Place inner);
  void number_inner_places(int chain);

  std::vector<std::int32_t> corridor_of_;  // by place
  std::vector<std::int32_t> position_;     // by place
  std::vector<Place> places_;              // chain after chain
  std::vector<std::int32_t> first_{0};     // by chain; one more for the end of the last
};

}  // namespace grove::detail
