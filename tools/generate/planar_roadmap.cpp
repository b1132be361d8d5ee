// SPDX-License-Identifier: MIT
// A random planar roadmap, which is the Gabriel graph of random points. Points p and q are joined
// unless a third point lies in or on the circle with diameter pq, that is, sees pq at an angle of
// at least 90 degrees.
//
// *Claim: two roads meet only at common ends.* *Proof.* Suppose that roads pq and rs without a
// common end cross. If none of the four points is on the other road, p r q s is a convex
// quadrilateral. Its angles sum to 360 degrees, so at least one of them is 90 degrees or more. The
// corner with that angle sees the diagonal between its neighbours, which is one of the roads, at
// that angle, so this road does not exist. If one of the points is on the other road, it sees that
// road at 180 degrees, so the road does not exist. Both cases are contradictions.
//
// *Claim: the graph is connected.* It contains every minimum spanning tree. If r lies in or on the
// circle over pq, then pr and rq are shorter than pq, so a spanning tree that contains pq becomes
// shorter if one of them replaces pq.
//
// *One-way roads.* The direction from b to a of a road can be removed without changing reachability
// if another path leads from b to a. In a strongly connected network this holds for at least one
// direction of every road that is not a bridge (Boesch, Tindell 1980), so no order of removals
// yields more one-way roads than another.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tools/generate/random.h"
#include "tools/generate/roadmap_generator.h"

namespace grove::detail {
namespace {

constexpr double kPerMetre = 100;
constexpr int kDrawsPerPoint = 200;

// Coordinates in centimetres, so that all computations are exact.
struct Spot {
  std::int64_t x;
  std::int64_t y;
};

std::int64_t centimetres(double metres) {
  return std::llround(metres * kPerMetre);
}

std::int64_t squared_distance(Spot a, Spot b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

bool is_in_circle_over(Spot p, Spot q, Spot r) {
  return (p.x - r.x) * (q.x - r.x) + (p.y - r.y) * (q.y - r.y) <= 0;
}

// --- points ---

std::vector<Spot> scatter(const PlanarRequest& request, Random& random) {
  const std::int64_t apart = std::max<std::int64_t>(centimetres(request.metres_per_step), 1);
  std::vector<Spot> spots;
  const auto is_free = [&](Spot spot) {
    return std::ranges::none_of(
        spots, [&](Spot other) { return squared_distance(spot, other) < apart * apart; });
  };
  int draws = 0;
  while (std::ssize(spots) < request.vertices) {
    const Spot spot{random.below(centimetres(request.width) + 1),
                    random.below(centimetres(request.height) + 1)};
    if (is_free(spot)) {
      spots.push_back(spot);
      draws = 0;
    } else if (++draws == kDrawsPerPoint) {
      throw std::invalid_argument(fmt::format(
          "{} vertices do not fit into {} x {} m at least a step of {} m apart; expected fewer",
          request.vertices, request.width, request.height, request.metres_per_step));
    }
  }
  return spots;
}

// --- roads ---

bool are_joined(const std::vector<Spot>& spots, std::size_t p, std::size_t q) {
  for (std::size_t r = 0; r < spots.size(); ++r)
    if (r != p && r != q && is_in_circle_over(spots[p], spots[q], spots[r])) return false;
  return true;
}

std::vector<Road> join(const std::vector<Spot>& spots, double metres_per_step) {
  std::vector<Road> roads;
  for (std::size_t p = 0; p < spots.size(); ++p) {
    for (std::size_t q = p + 1; q < spots.size(); ++q) {
      if (!are_joined(spots, p, q)) continue;
      const auto squared = static_cast<double>(squared_distance(spots[p], spots[q]));
      roads.push_back({static_cast<int>(p), static_cast<int>(q),
                       steps_of(std::sqrt(squared) / kPerMetre, metres_per_step)});
    }
  }
  return roads;
}

// --- one-way roads ---

class OneWayRoads {
 public:
  OneWayRoads(std::vector<Road>& roads, int vertices) : roads_(roads), at_(vertices) {
    for (std::size_t k = 0; k < roads.size(); ++k) {
      at_[roads[k].from].push_back(k);
      at_[roads[k].to].push_back(k);
    }
  }

  void make(std::size_t wanted, Random& random) {
    std::vector<std::size_t> order(roads_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);
    for (const std::size_t k : order) {
      if (wanted == 0) return;
      if (random.below(2) == 1) turn_round(k);
      if (make_one_way(k)) --wanted;
    }
  }

 private:
  void turn_round(std::size_t k) { std::swap(roads_[k].from, roads_[k].to); }

  bool make_one_way(std::size_t k) {
    if (!has_other_way_back(k)) turn_round(k);
    roads_[k].one_way = has_other_way_back(k);
    return roads_[k].one_way;
  }

  bool has_other_way_back(std::size_t without) const {
    std::vector<bool> seen(at_.size());
    std::vector<int> stack{roads_[without].to};
    seen[roads_[without].to] = true;
    while (!stack.empty()) {
      const int here = stack.back();
      stack.pop_back();
      for (const std::size_t k : at_[here]) {
        const Road& road = roads_[k];
        if (k == without || (road.one_way && road.from != here)) continue;
        const int next = road.from == here ? road.to : road.from;
        if (seen[next]) continue;
        seen[next] = true;
        stack.push_back(next);
      }
    }
    return seen[roads_[without].from];
  }

  std::vector<Road>& roads_;
  std::vector<std::vector<std::size_t>> at_;  // by vertex: positions of its roads in roads_
};

std::vector<Vertex> name(const std::vector<Spot>& spots) {
  std::vector<Vertex> vertices;
  for (const Spot spot : spots)
    vertices.push_back(
        {fmt::format("v{}", vertices.size()),
         {static_cast<double>(spot.x) / kPerMetre, static_cast<double>(spot.y) / kPerMetre}});
  return vertices;
}

}  // namespace

Roadmap planar_roadmap(const PlanarRequest& request) {
  Random random = random_for(RandomUse::kRoadmap, request.seed);
  const std::vector<Spot> spots = scatter(request, random);
  std::vector<Road> roads = join(spots, request.metres_per_step);
  const std::size_t one_way = (roads.size() * request.one_way + 50) / 100;
  OneWayRoads(roads, request.vertices).make(one_way, random);
  return Roadmap(name(spots), std::move(roads));
}

}  // namespace grove::detail
