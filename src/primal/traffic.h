// SPDX-License-Identifier: MIT
// Traffic of plans, and distances that include its congestion costs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/distance_field.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "model/world.h"

namespace grove::detail {

// Counts the visits of places and the moves between them, at any time, and computes distances in
// which a step costs more the more traffic it meets, on the place or in the opposite direction. One
// thread at a time.
class Traffic {
 public:
  // `world` and `tuning` must outlive this. `usual`: the amount of traffic that raises the cost
  // of a step by vertex_congestion_weight (traffic on the place) or contraflow_weight (in the
  // opposite direction) times its cost without traffic.
  Traffic(const World& world, double usual, const Tuning& tuning);

  // Multiplies all counts by `left`.
  void fade(double left);
  void add(const Path& path, double weight);
  // Computes the costs that field() uses from the current counts.
  void update_edge_costs();

  // The least cost, congestion included, in units of 1 / kStep step, from every state to a state
  // that is 0 in `distance`; kNever if there is no path. O(states).
  DistanceField field(DistanceView distance);

 private:
  using Move = std::size_t;         // index of a move between places, grouped by its origin
  static constexpr Time kStep = 8;  // cost of a step without traffic
  static constexpr double kMaxCongestionCost = 60;
  static constexpr std::size_t kBuckets = 512;  // more than any edge cost
  static_assert(kStep * (1 + kMaxCongestionCost) < kBuckets);

  Move move(Place from, Place to) const;
  template <class Visit>
  void visit_before(State state, Visit visit) const;

  const World& world_;
  const double usual_;
  const Tuning& tuning_;
  std::vector<Move> first_;      // by place
  std::vector<double> there_;    // by place: steps that end there
  std::vector<double> moving_;   // by move
  std::vector<Time> edge_cost_;  // by move: cost of the reverse move
  std::vector<std::vector<State>> buckets_;
};

}  // namespace grove::detail
