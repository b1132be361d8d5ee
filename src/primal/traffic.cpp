// SPDX-License-Identifier: MIT
// If all agents take shortest paths, they jam where the paths meet, and a jam costs more than a
// detour. The traffic of a plan, waits included, shows where jams are. The next plan
// (traffic_guided_lacam.cpp) uses distances in which steps through traffic cost more. Source: Chen,
// Harabor, Li and Stuckey, AAAI 2024, who count the traffic of paths that are planned beforehand.
// In measurements the traffic of earlier plans, which includes waits, was as good. Moves against a
// stream cost more than moves along it, so that opposite streams separate.
#include "primal/traffic.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {

Traffic::Traffic(const World& world, double usual, const Tuning& tuning)
    : world_(world),
      usual_(usual),
      tuning_(tuning),
      visits_(static_cast<std::size_t>(world.place_count()), 0),
      buckets_(kBuckets) {
  first_.push_back(0);
  for (Place place = 0; place < world.place_count(); ++place)
    first_.push_back(first_.back() + world.neighbors(place).size());
  moving_.resize(first_.back(), 0);
  edge_cost_.resize(first_.back(), kStep);
}

Traffic::Move Traffic::move(Place from, Place to) const {
  const auto neighbors = world_.neighbors(from);
  const auto neighbor = std::ranges::find(neighbors, to);
  GROVE_ASSERT(neighbor != neighbors.end(), "a move leads to a neighbour");
  return first_[from] + static_cast<Move>(neighbor - neighbors.begin());
}

void Traffic::fade(double left) {
  for (double& steps : visits_) steps *= left;
  for (double& steps : moving_) steps *= left;
}

void Traffic::add(const Path& path, double weight) {
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Place from = world_.place(path[t - 1]);
    const Place to = world_.place(path[t]);
    visits_[to] += weight;
    if (from != to) moving_[move(from, to)] += weight;
  }
}

void Traffic::update_edge_costs() {
  for (Place place = 0; place < world_.place_count(); ++place)
    for (Move back = first_[place]; back < first_[place + 1]; ++back) {
      const double congestion_cost = (tuning_.vertex_congestion_weight * visits_[place] +
                                      tuning_.contraflow_weight * moving_[back]) /
                                     usual_;
      edge_cost_[back] =
          static_cast<Time>(kStep * (1 + std::min(congestion_cost, kMaxCongestionCost)));
    }
}

// Calls visit(before, cost) for each state `before` from which a move, of this cost, leads to
// `state`.
template <class Visit>
void Traffic::visit_before(State state, Visit visit) const {
  const auto states = world_.moves_to(state);
  const Place place = world_.place(state);
  if (world_.is_plain()) {
    for (std::size_t i = 0; i < states.size(); ++i) visit(states[i], edge_cost_[first_[place] + i]);
    return;
  }
  for (const State before : states) {
    const Place from = world_.place(before);
    visit(before, from == place ? kStep : edge_cost_[move(place, from)]);
  }
}

// Dijkstra's algorithm with a circular bucket queue: one bucket for each cost modulo kBuckets.
DistanceField Traffic::field(DistanceView distance) {
  DistanceField congestion_cost(static_cast<std::size_t>(world_.state_count()), kNever);
  std::size_t left = 0;
  const auto reach = [&](State state, Time cost) {
    if (cost >= congestion_cost[state]) return;
    congestion_cost[state] = cost;
    buckets_[static_cast<std::size_t>(cost) % kBuckets].push_back(state);
    ++left;
  };
  for (State state = 0; state < world_.state_count(); ++state)
    if (distance[state] == 0) reach(state, 0);
  for (Time cost = 0; left > 0; ++cost) {
    std::vector<State>& bucket = buckets_[static_cast<std::size_t>(cost) % kBuckets];
    for (; !bucket.empty(); --left) {
      const State state = bucket.back();
      bucket.pop_back();
      GROVE_ASSERT(congestion_cost[state] <= cost, "the cost of a state never rises");
      if (congestion_cost[state] != cost) continue;
      visit_before(state, [&](State before, Time price) { reach(before, cost + price); });
    }
  }
  return congestion_cost;
}

}  // namespace grove::detail
