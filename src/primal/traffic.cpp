// SPDX-License-Identifier: MIT
// Agents that all take a shortest way jam where these meet, and a jam costs more than the way
// around it. What tells where is the traffic of a plan, waits included: so distances in which it is
// dear make the next plan (guided_search.cpp). (Guidance by traffic: Chen, Harabor, Li and Stuckey,
// AAAI 2024, who count ways that are planned beforehand; a plan's own traffic does as well,
// measured, and knows of waits.) Moves against a stream are dearer than those along it, so streams
// part.
#include "primal/traffic.h"

#include <algorithm>

namespace grove::detail {

Traffic::Traffic(const World& world, double defaults, const Tuning& tuning)
    : world_(world),
      usual_(defaults),
      tuning_(tuning),
      there_(static_cast<std::size_t>(world.place_count()), 0),
      buckets_(kBuckets) {
  first_.push_back(0);
  for (Place place = 0; place < world.place_count(); ++place)
    first_.push_back(first_.back() + world.neighbors(place).size());
  moving_.resize(first_.back(), 0);
  price_back_.resize(first_.back(), kStep);
}

Traffic::Move Traffic::move(Place from, Place to) const {
  const auto neighbors = world_.neighbors(from);
  return first_[from] + static_cast<Move>(std::ranges::find(neighbors, to) - neighbors.begin());
}

void Traffic::fade(double left) {
  for (double& steps : there_) steps *= left;
  for (double& steps : moving_) steps *= left;
}

void Traffic::add(const Path& path, double weight) {
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Place from = world_.place(path[t - 1]);
    const Place to = world_.place(path[t]);
    there_[to] += weight;
    if (from != to) moving_[move(from, to)] += weight;
  }
}

void Traffic::set_prices() {
  for (Place place = 0; place < world_.place_count(); ++place)
    for (Move back = first_[place]; back < first_[place + 1]; ++back) {
      const double dearness =
          (tuning_.traffic_there * there_[place] + tuning_.traffic_against * moving_[back]) /
          usual_;
      price_back_[back] = static_cast<Time>(kStep * (1 + std::min(dearness, kMostDearness)));
    }
}

// Calls visit(before, price) for each state that a move leads from to this one.
template <class Visit>
void Traffic::visit_before(State state, Visit visit) const {
  const auto states = world_.moves_to(state);
  const Place place = world_.place(state);
  if (world_.is_plain()) {
    for (std::size_t i = 0; i < states.size(); ++i)
      visit(states[i], price_back_[first_[place] + i]);
    return;
  }
  for (const State before : states) {
    const Place from = world_.place(before);
    visit(before, from == place ? kStep : price_back_[move(place, from)]);
  }
}

// Dijkstra with a bucket for each dearness, used again and again.
DistanceField Traffic::field(DistanceView distance) {
  DistanceField dearness(static_cast<std::size_t>(world_.state_count()), kNever);
  std::size_t left = 0;
  const auto reach = [&](State state, Time dear) {
    if (dear >= dearness[state]) return;
    dearness[state] = dear;
    buckets_[static_cast<std::size_t>(dear) % kBuckets].push_back(state);
    ++left;
  };
  for (State state = 0; state < world_.state_count(); ++state)
    if (distance[state] == 0) reach(state, 0);
  for (Time dear = 0; left > 0; ++dear) {
    std::vector<State>& bucket = buckets_[static_cast<std::size_t>(dear) % kBuckets];
    for (; !bucket.empty(); --left) {
      const State state = bucket.back();
      bucket.pop_back();
      if (dearness[state] != dear) continue;
      visit_before(state, [&](State before, Time price) { reach(before, dear + price); });
    }
  }
  return dearness;
}

}  // namespace grove::detail
