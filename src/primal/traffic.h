// SPDX-License-Identifier: MIT
// Where many agents pass, and ways around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/distance_field.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "model/world.h"

namespace grove::detail {

// Counts who is on a place and who moves from one to another, whenever that is, and makes distances
// in which steps are the dearer the more traffic they go through, or against. For one thread.
class Traffic {
 public:
  // `world` and `tuning` must outlive this. `usual`: traffic of so much makes a step twice as dear,
  // or more by the tuned numbers.
  Traffic(const World& world, double defaults, const Tuning& tuning);

  // What is known counts for so many times what it did.
  void fade(double left);
  void add(const Path& path, double weight);
  // From now on field() knows what was added.
  void set_prices();

  // The dearness of the cheapest way from every state to one that is 0 in `distance`; kNever where
  // there is none. O(states).
  DistanceField field(DistanceView distance);

 private:
  using Move = std::size_t;         // between places, by the first place
  static constexpr Time kStep = 8;  // the price of a step without traffic
  static constexpr double kMostDearness = 60;
  static constexpr std::size_t kBuckets = 512;  // more than any price
  static_assert(kStep * (1 + kMostDearness) < kBuckets);

  Move move(Place from, Place to) const;
  template <class Visit>
  void visit_before(State state, Visit visit) const;

  const World& world_;
  const double usual_;
  const Tuning& tuning_;
  std::vector<Move> first_;       // by place
  std::vector<double> there_;     // by place: steps that agents end there
  std::vector<double> moving_;    // by move
  std::vector<Time> price_back_;  // by move: the price of that in the other direction
  std::vector<std::vector<State>> buckets_;
};

}  // namespace grove::detail
