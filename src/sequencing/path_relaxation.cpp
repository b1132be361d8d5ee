// SPDX-License-Identifier: MIT
// Spanning trees under node potentials.
//
// Held and Karp's bound (1970, 1971) for a path instead of a tour. A way from `from` through all
// stops of a set S to the end is a first leg, a path that spans S, and a last leg. A spanning path
// is a spanning tree, so
//
//   minimum spanning tree of S + min over u, w in S of (first leg to u + last leg from w)
//
// (u and w different stops unless S is a single one) bounds the way from below. Adding a potential
// p(u) to every leg end at u changes the cost of every way alike, by 2 p(u) for each u in S,
// because the way touches every stop of S twice; it does not change every *tree* alike. So for any
// potentials
//
//   min tree with potentials + first and last leg with theirs - 2 * sum of p over S
//
// is a bound too, and good potentials make it nearly tight. They come from subgradient ascent over
// all stops: raise p where the tree branches, lower it where it ends. Potentials that serve the
// whole set serve its subsets well enough, and the bound holds for any.
//
// A way that begins at u in S, and goes through the rest of S to the end, is a path that spans S
// too, from u, and a last leg from another stop. It touches u once less: so the minimum spanning
// tree with potentials, the last leg with its own and p(u), less twice the sum, bounds it.
//
// Everything is in fixed point: costs are integers times kScale, potentials are integers, so the
// bound is computed exactly and rounding up to a multiple of kScale is sound, costs being integers.
// Edges of the tree take the cheaper direction, so that a matrix need not be symmetric. But where
// work takes time, each leg to a stop has that stop's work in it, and the cheaper direction knows
// only the lesser of two. So legs are *balanced* first: a number s(u) is added to every leg from u
// and taken off every leg to u. That changes no way through u; a way that begins at u costs s(u)
// more then, which its bound is lowered by. With s(u) half of what legs to u cost more than those
// from u, on the mean, work is shared evenly between the two legs of a stop.
#include "path_relaxation.h"

#include <array>
#include <cmath>

#include "grove/sequencing/cost_matrix.h"
#include "grove/sequencing/rtsp.h"

namespace grove {
namespace {

constexpr int kSteps = 400;
constexpr std::int64_t kScale = 256;
// The leg that does not exist. Far above any sum of real legs and potentials (65 legs of 2^30 steps
// times kScale are below 2^45, potentials are kept within kMostPotential), and 130 of them fit.
constexpr std::int64_t kNoLeg = std::int64_t{1} << 54;
constexpr std::int64_t kSurelyNoWay = kNoLeg / 2;
constexpr std::int64_t kMostPotential = std::int64_t{1} << 43;

// Both bounds are proven at every step, so what comes out must be a cost.
Time to_cost(std::int64_t fixed_point) {
  if (fixed_point >= kSurelyNoWay) return kNever;
  return static_cast<Time>(std::max<std::int64_t>(0, fixed_point + kScale - 1) / kScale);
}

}  // namespace

// A minimum spanning tree by Prim's algorithm: its weight and, in the order of `stops`, the number
// of tree edges at each stop.
struct PathRelaxation::Tree {
  std::int64_t weight = 0;
  int size = 0;
  std::array<Stop, kMaxTasksPerAgent> stops;
  std::array<std::uint8_t, kMaxTasksPerAgent> degree{};
};

// The cheapest pair of first and last leg, and the stops where they meet the tree.
struct PathRelaxation::EndLegs {
  std::int64_t cost = 4 * kNoLeg;
  int first = 0;
  int last = 0;
};

PathRelaxation::PathRelaxation(const CostMatrix& matrix)
    : stops_(matrix.stops()), potential_(stops_, 0), weight_(stops_ * stops_) {
  for (int from = 0; from <= stops_; ++from)
    for (int to = 0; to <= stops_; ++to) {
      const Time cost = matrix.between(from, to);
      legs_.push_back(cost >= kNever ? kNoLeg : cost * kScale);
    }
  if (stops_ == 0)
    root_bound_ = matrix.to_end(0);
  else {
    balance();
    climb();
  }
}

void PathRelaxation::balance() {
  shift_.assign(static_cast<std::size_t>(stops_) + 1, 0);
  for (int i = 0; i < stops_; ++i) {
    std::int64_t more = 0;
    std::int64_t pairs = 0;
    for (int j = 0; j < stops_; ++j) {
      if (i == j || leg(i, j) == kNoLeg || leg(j, i) == kNoLeg) continue;
      more += leg(j, i) - leg(i, j);
      ++pairs;
    }
    if (pairs > 0) shift_[i] = more / (2 * pairs);
  }
  for (int from = 0; from <= stops_; ++from)
    for (int to = 0; to <= stops_; ++to)
      if (std::int64_t& leg = legs_[from * (stops_ + 1) + to]; leg != kNoLeg && from != to)
        leg += shift_[from] - shift_[to];
}

void PathRelaxation::shift_weights() {
  for (int i = 0; i < stops_; ++i)
    for (int j = 0; j < stops_; ++j)
      weight_[i * stops_ + j] = std::min(leg(i, j), leg(j, i)) + potential_[i] + potential_[j];
}

PathRelaxation::Tree PathRelaxation::tree(StopSet left) const {
  Tree tree;
  for_each_stop(left, [&](int stop) { tree.stops[tree.size++] = static_cast<Stop>(stop); });
  // tree.stops[0 .. in_tree-1] are connected; the others wait with their cheapest edge to those.
  std::array<std::int64_t, kMaxTasksPerAgent> edge;
  std::array<std::uint8_t, kMaxTasksPerAgent> parent{};
  const std::int64_t* row = &weight_[tree.stops[0] * stops_];
  for (int i = 1; i < tree.size; ++i) edge[i] = row[tree.stops[i]];
  for (int in_tree = 1; in_tree < tree.size; ++in_tree) {
    int next = in_tree;
    for (int i = in_tree + 1; i < tree.size; ++i)
      if (edge[i] < edge[next]) next = i;
    tree.weight += edge[next];
    ++tree.degree[parent[next]];
    ++tree.degree[in_tree];
    std::swap(tree.stops[next], tree.stops[in_tree]);
    edge[next] = edge[in_tree];
    parent[next] = parent[in_tree];

    row = &weight_[tree.stops[in_tree] * stops_];
    for (int i = in_tree + 1; i < tree.size; ++i)
      if (const std::int64_t weight = row[tree.stops[i]]; weight < edge[i]) {
        edge[i] = weight;
        parent[i] = static_cast<std::uint8_t>(in_tree);
      }
  }
  return tree;
}

void PathRelaxation::add_end_legs(Tail& tail, StopSet left) const {
  const auto last_leg = [&](int stop) { return leg(stop, stops_) + potential_[stop]; };
  const auto nearest = [&](StopSet among) {
    int best = std::countr_zero(among);
    for_each_stop(among, [&](int stop) {
      if (last_leg(stop) < last_leg(best)) best = stop;
    });
    return best;
  };
  tail.nearest_to_end = nearest(left);
  const StopSet others = left & ~bit(tail.nearest_to_end);
  tail.second_to_end = others == 0 ? tail.nearest_to_end : nearest(others);
  tail.last_leg = last_leg(tail.nearest_to_end);
  tail.second_leg = last_leg(tail.second_to_end);
  for_each_stop(left, [&](int stop) { tail.tree -= 2 * potential_[stop]; });
}

PathRelaxation::Tail PathRelaxation::tail(StopSet left) const {
  Tail tail;
  tail.tree = tree(left).weight;
  add_end_legs(tail, left);
  return tail;
}

PathRelaxation::EndLegs PathRelaxation::end_legs(const Tail& tail, StopSet next, int from) const {
  EndLegs best;
  for_each_stop(next, [&](int stop) {
    const bool taken = stop == tail.nearest_to_end;
    const std::int64_t cost =
        leg(from, stop) + potential_[stop] + (taken ? tail.second_leg : tail.last_leg);
    if (cost < best.cost) best = {cost, stop, taken ? tail.second_to_end : tail.nearest_to_end};
  });
  return best;
}

Time PathRelaxation::bound(const Tail& tail, StopSet next, int from) const {
  return to_cost(tail.tree + end_legs(tail, next, from).cost - shift_[from]);
}

Time PathRelaxation::bound_from(const Tail& tail, int first) const {
  return to_cost(tail.tree + potential_[first] +
                 (first == tail.nearest_to_end ? tail.second_leg : tail.last_leg) - shift_[first]);
}

// The bound from the start over all stops, and how many legs of the relaxed way touch each.
std::int64_t PathRelaxation::bound_and_degrees(std::vector<int>& degree) const {
  const StopSet all = stops_ == 64 ? ~StopSet{0} : bit(stops_) - 1;
  const Tree span = tree(all);
  Tail tail;
  tail.tree = span.weight;
  add_end_legs(tail, all);
  const EndLegs ends = end_legs(tail, all, stops_);

  for (int i = 0; i < span.size; ++i) degree[span.stops[i]] = span.degree[i];
  ++degree[ends.first];
  ++degree[ends.last];
  return tail.tree + ends.cost;
}

// Subgradient ascent with a step that shrinks geometrically and some of the last direction kept
// (Volgenant and Jonker 1982). Any potentials are sound; the best ones met are kept.
void PathRelaxation::climb() {
  std::vector<int> degree(stops_, 2);
  std::vector<int> last_degree(stops_, 2);
  std::vector<std::int64_t> best_potential = potential_;
  shift_weights();
  std::int64_t best = bound_and_degrees(last_degree);
  double step = static_cast<double>(best) / (4.0 * stops_);
  const double shrink = step > 1 ? std::pow(1 / step, 1.0 / kSteps) : 1;
  for (int k = 0; k < kSteps && best < kSurelyNoWay; ++k, step *= shrink) {
    const std::int64_t bound = bound_and_degrees(degree);
    if (bound > best) {
      best = bound;
      best_potential = potential_;
    }
    if (std::ranges::all_of(degree, [](int d) { return d == 2; }))
      break;  // a path: nothing to gain
    for (int i = 0; i < stops_; ++i) {
      const double direction = 0.7 * (degree[i] - 2) + 0.3 * (last_degree[i] - 2);
      const std::int64_t moved = potential_[i] + std::llround(step * direction);
      potential_[i] = std::clamp(moved, -kMostPotential, kMostPotential);
    }
    shift_weights();
    std::swap(degree, last_degree);
  }
  potential_ = best_potential;
  shift_weights();
  root_bound_ = to_cost(best);
}

Time relaxation_bound(const CostMatrix& matrix) {
  return PathRelaxation(matrix).root_bound();
}

}  // namespace grove
