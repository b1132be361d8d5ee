// SPDX-License-Identifier: MIT
// Agents that all take a shortest way jam where these meet, and a jam costs more than the way around
// it. What tells where is the traffic of a plan, waits included: so distances in which it is dear
// make the next plan (guided_search.cpp). (Guidance by traffic: Chen, Harabor, Li and Stuckey, AAAI
// 2024, who count ways that are planned beforehand; a plan's own traffic does as well, measured, and
// knows of waits.) Moves against a stream are dearer than those along it, so streams part.
#include "traffic.h"

#include <algorithm>

namespace grove::detail {

Traffic::Traffic(const World& world, double usual, const Tuning& tuning)
    : world_(world),
      usual_(usual),
      tuning_(tuning),
      there_(static_cast<std::size_t>(world.place_count()), 0),
      buckets_(kBuckets) {
  first_.push_back(0);
  for (Place place = 0; place < world.place_count(); ++place)
    first_.push_back(first_.back() + world.neighbors(place).size());
  moving_.resize(first_.back(), 0);
  price_.resize(first_.back(), kStep);
  for (Place place = 0; place < world.place_count(); ++place)
    for (const Place neighbor : world.neighbors(place)) back_.push_back(move(neighbor, place));
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
    for (const Place to : world_.neighbors(place)) {
      const Move there = move(place, to);
      const double dearness =
          (tuning_.traffic_there * there_[to] + tuning_.traffic_against * moving_[back_[there]]) /
          usual_;
      price_[there] = static_cast<Time>(kStep * (1 + std::min(dearness, kMostDearness)));
    }
}

Time Traffic::price(State from, State to) const {
  const Place before = world_.place(from);
  const Place after = world_.place(to);
  return before == after ? kStep : price_[move(before, after)];
}

// Dijkstra with a bucket for each dearness, used again and again.
DistanceField Traffic::field(const DistanceField& distance) {
  DistanceField dearness(distance.size(), kNever);
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
      for (const State before : world_.moves_to(state)) reach(before, dear + price(before, state));
    }
  }
  return dearness;
}

}  // namespace grove::detail
