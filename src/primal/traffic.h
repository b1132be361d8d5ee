// SPDX-License-Identifier: MIT
// Traffic of plans, and distances that include congestion costs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/distance_field.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "model/world.h"

namespace grove::detail {

// Counts how much plans use each place and each move, over all times, and computes distances in
// which a step costs more, the more traffic is on its place or in the opposite direction. One
// thread at a time.
class Traffic {
 public:
  // `world` and `tuning` must outlive this object. `usual`: amount of traffic that raises the cost
  // of a step by vertex_congestion_weight (traffic on the place) or contraflow_weight (traffic in
  // the opposite direction) times its cost without traffic.
  Traffic(const World& world, double usual, const Tuning& tuning);

  // Multiplies all counts by `left`, from 0 to 1.
  void fade(double left);
  void add(const Path& path, double weight);
  // Computes, from the current counts, the costs that field() uses.
  void update_edge_costs();

  // Returns the least cost from each state to a state with distance 0 in `distance`, congestion
  // included, in units of 1 / kStep step; kNever if there is no path. Takes time proportional to
  // the number of moves plus the greatest finite cost.
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
  std::vector<double> visits_;   // by place: steps that end there (traffic)
  std::vector<double> moving_;   // by move
  std::vector<Time> edge_cost_;  // by move: cost of the reverse move
  std::vector<std::vector<State>> buckets_;
};

}  // namespace grove::detail
