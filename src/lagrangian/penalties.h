// SPDX-License-Identifier: MIT
// Penalties on the steps of a path, from Lagrangian multipliers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// Penalties by arrival time and *arc*. An arc is a pair of neighbouring places, or a place on which
// the agent stays. Amounts are integers >= 0; kUnit is the cost of one step. Memory grows with the
// number of penalised arcs and times, in pages of kOnPage arcs. One thread at a time while it is
// changed; otherwise any thread may read it.
class Penalties {
 public:
  using Amount = std::int32_t;
  using Arc = std::int32_t;
  static constexpr Amount kUnit = 1 << 10;

  // `world` must outlive this.
  explicit Penalties(const World& world);

  const World& world() const { return world_; }
  Arc staying(Place place) const { return first_arc_[place]; }
  // `to` is `from` itself or a neighbour.
  Arc arc(Place from, Place to) const;
  // The arcs of the moves of a state, in the order of the moves.
  std::span<const Arc> arcs(State state) const {
    const std::span<const State> moves = world_.moves(state);
    return {arc_of_move_.data() + (moves.data() - first_move_), moves.size()};
  }
  // All arcs that lead to a place, including staying(place).
  std::span<const Arc> arcs_to(Place place) const { return arcs_to_[place]; }

  // The penalties of one arrival time.
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
  // Valid until the next add().
  Layer at(Time arrival) const {
    Layer layer;
    if (arrival >= end()) return layer;
    layer.pages_of_arcs_ = pages_of_time_[arrival].data();
    layer.amounts_ = pages_.data();
    return layer;
  }
  Amount of(Time arrival, Arc arc) const { return at(arrival)[arc]; }
  // Adds to a penalty. Throws std::overflow_error if the penalty would exceed kMaxPenalty.
  void add(Time arrival, Arc arc, Amount amount);
  // There are no penalties at this time or later.
  Time end() const { return static_cast<Time>(pages_of_time_.size()); }

 private:
  static constexpr std::size_t kOnPage = 64;
  static constexpr Amount kMaxPenalty = 1 << 28;

  const World& world_;
  const State* first_move_;  // the moves of state 0, which are the first of all
  std::vector<Arc> first_arc_;
  std::vector<Arc> arc_of_move_;
  CsrArray arcs_to_;
  std::size_t arcs_ = 0;
  std::vector<std::vector<std::uint32_t>> pages_of_time_;  // 0: no penalties on that page
  std::vector<Amount> pages_;
};

}  // namespace grove::detail
