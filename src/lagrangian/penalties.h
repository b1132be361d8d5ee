// SPDX-License-Identifier: MIT
// What multipliers add to the cost of a path, step by step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// Penalties on steps: on arriving at a time by an *arc*, which is a place and one next to it, or a
// place on which the agent stays. Amounts are integers; kUnit stands for a cost of one step.
// Nobody pays less than 0. Memory goes with the spots that are penalised.
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
  // By the moves of a state, in their order.
  std::span<const Arc> arcs(State state) const {
    const std::span<const State> moves = world_.moves(state);
    return {arc_of_move_.data() + (moves.data() - first_move_), moves.size()};
  }
  // All that lead to a place, its staying() among them.
  std::span<const Arc> arcs_to(Place place) const { return arcs_to_[place]; }

  // Those of one time.
  class Layer {
   public:
    Amount operator[](Arc arc) const {
      if (pages_of_arcs_ == nullptr) return 0;
      const std::size_t page = pages_of_arcs_[static_cast<std::size_t>(arc) / kOnPage];
      return amounts_[page * kOnPage + static_cast<std::size_t>(arc) % kOnPage];
    }

   private:
    friend class Penalties;
    const std::uint32_t* pages_of_arcs_ = nullptr;  // null: nothing is penalised
    const Amount* amounts_ = nullptr;
  };
  // Until the next add().
  Layer at(Time arrival) const {
    Layer layer;
    if (arrival >= end()) return layer;
    layer.pages_of_arcs_ = pages_of_time_[arrival].data();
    layer.amounts_ = pages_.data();
    return layer;
  }
  Amount of(Time arrival, Arc arc) const { return at(arrival)[arc]; }
  // Throws std::overflow_error when it would become too much to be reckoned with.
  void add(Time arrival, Arc arc, Amount amount);
  // Nothing is penalised then, or later.
  Time end() const { return static_cast<Time>(pages_of_time_.size()); }

 private:
  static constexpr std::size_t kOnPage = 64;
  static constexpr Amount kMost = 1 << 28;

  const World& world_;
  const State* first_move_;  // of all states
  std::vector<Arc> first_arc_;
  std::vector<Arc> arc_of_move_;
  CsrArray arcs_to_;
  std::size_t arcs_ = 0;
  std::vector<std::vector<std::uint32_t>> pages_of_time_;  // 0: nothing is penalised there
  std::vector<Amount> pages_;
};

}  // namespace grove::detail
