// SPDX-License-Identifier: MIT
// Penalties on the steps of a path, from Lagrangian multipliers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// Penalties by arrival time and *arc*. An arc is an ordered pair of neighbouring places, or a place
// on which an agent stays. Amounts are integers >= 0; kUnit is the cost of one step. Memory is
// allocated in pages of kOnPage arcs at one time. While one thread changes the object, no other
// thread may use it; otherwise any thread may read it.
class Penalties {
 public:
  using Amount = std::int32_t;
  using Arc = std::int32_t;
  static constexpr Amount kUnit = 1 << 10;

  // `world` must outlive this object.
  explicit Penalties(const World& world);

  const World& world() const { return world_; }
  Arc staying(Place place) const { return first_arc_[place]; }
  // Precondition: `to` is `from` or a neighbour of it.
  Arc arc(Place from, Place to) const;
  // The arcs of the moves from a state, in the order of World::moves().
  std::span<const Arc> arcs(State state) const {
    const std::span<const State> moves = world_.moves(state);
    return {arc_of_move_.data() + (moves.data() - first_move_), moves.size()};
  }
  // All arcs that lead to a place, including staying(place).
  std::span<const Arc> arcs_to(Place place) const { return arcs_to_[place]; }

  // The penalties for one arrival time, by arc.
  class Layer {
   public:
    Amount operator[](Arc arc) const {
      if (pages_of_arcs_ == nullptr) return 0;
      const std::size_t page = pages_of_arcs_[static_cast<std::size_t>(arc) / kOnPage];
      return amounts_[page * kOnPage + static_cast<std::size_t>(arc) % kOnPage];
    }

   private:
    friend class Penalties;
    const std::uint32_t* pages_of_arcs_ = nullptr;  // nullptr: no penalties
    const Amount* amounts_ = nullptr;
  };
  // The penalties for arrival at time `arrival`. The result is valid until the next add().
  Layer at(Time arrival) const {
    Layer layer;
    if (arrival >= end()) return layer;
    layer.pages_of_arcs_ = pages_of_time_[arrival].data();
    layer.amounts_ = pages_.data();
    return layer;
  }
  Amount of(Time arrival, Arc arc) const { return at(arrival)[arc]; }
  // Adds `amount`, which may be negative, to a penalty. Precondition: the sum is >= 0. Throws
  // std::overflow_error if the sum would exceed kMaxPenalty.
  void add(Time arrival, Arc arc, Amount amount);
  // All penalties for arrival at this time or later are 0.
  Time end() const { return static_cast<Time>(pages_of_time_.size()); }

 private:
  static constexpr std::size_t kOnPage = 64;
  static constexpr Amount kMaxPenalty = 1 << 28;

  const World& world_;
  const State* first_move_;  // start of the array of all moves
  std::vector<Arc> first_arc_;
  std::vector<Arc> arc_of_move_;
  CsrArray arcs_to_;
  std::size_t arcs_ = 0;
  std::vector<std::vector<std::uint32_t>>
      pages_of_time_;  // by arrival time and page of arcs; 0: none
  std::vector<Amount> pages_;
};

}  // namespace grove::detail
