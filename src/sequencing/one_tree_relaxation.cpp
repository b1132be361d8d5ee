// SPDX-License-Identifier: MIT
// The 1-tree bound of Held and Karp (1970, 1971), for a path instead of a tour: spanning trees
// under node potentials.
//
// *Bound.* A path from `from` through all stops of a set S to the end consists of a first leg, a
// path that spans S, and a last leg. A spanning path is a spanning tree, so
//
//   minimum spanning tree of S + min over u, w in S of (first leg to u + last leg from w)
//
// (u and w different stops unless |S| = 1) is a lower bound. If a potential p(u) is added to each
// leg for each of its ends at u, the cost of every path changes by the same amount, 2 p(u) for each
// u in S, because every stop of S is an end of two legs. The weights of different *trees* change by
// different amounts. So for any potentials
//
//   min tree with potentials + first and last leg with theirs - 2 * sum of p over S
//
// is a lower bound, too, and with good potentials it is nearly tight. Subgradient ascent over the
// set of all stops computes them: it raises p where the tree branches and lowers p at leaves. The
// potentials for the whole set are also used for its subsets, where the bound holds as well,
// because it holds for any potentials.
//
// *First stop given.* A path that begins at u in S and visits the other stops of S before the end
// consists of a path that spans S, starting at u, and a last leg from another stop. Here u is an
// end of only one leg. So the minimum spanning tree with potentials, plus the last leg with its own
// potential, plus p(u), minus twice the sum, is a lower bound.
//
// *Fixed point.* Costs are stored as multiples of kScale and potentials as integers, so the bound
// is computed exactly. Rounding it up to a multiple of kScale is sound, because true costs are
// integers.
//
// *Balancing.* An edge of the tree has the cost of the cheaper direction, so the matrix need not be
// symmetric. However, if tasks take time, each leg to a stop includes the duration of the task at
// this stop, and the cheaper direction includes only the lesser of two durations. So legs are
// *balanced* first: a number s(u) is added to every leg from u and subtracted from every leg to u.
// This does not change the cost of a path through u. The cost of a path that begins at u rises by
// s(u), so its bound is reduced by s(u). If s(u) is half of the mean excess of legs to u over legs
// from u, the duration is divided evenly between the two legs at a stop.
//
// *Ports.* If stops have ports (cost_matrix.h), a leg of the relaxation uses the cheapest port at
// each end. Two legs at a stop can use different ports, so the relaxation omits the turn between
// them. To recover part of it, s can differ from port to port: a real path enters and leaves a stop
// by the same port, so that the s added to one leg and the s subtracted from the other cancel out.
// If the relaxed path leaves a port more often than it enters it, a greater s raises its cost. So
// the ascent changes s together with p.
#include "sequencing/one_tree_relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/rtsp.h"

namespace grove::detail {
namespace {

constexpr int kSteps = 400;
constexpr std::int64_t kScale = 256;
// Cost of a leg that does not exist. It is far above any sum of real legs and potentials (65 legs
// of 2^30 steps, times kScale, are below 2^45, and kMaxPotential limits the potentials), and 130
// times kNoLeg fits into 64 bits.
constexpr std::int64_t kNoLeg = std::int64_t{1} << 54;
constexpr std::int64_t kSurelyNoWay = kNoLeg / 2;
constexpr std::int64_t kMaxPotential = std::int64_t{1} << 43;

// Converts a lower bound to a cost. Rounds up, because the true cost is an integer.
Time to_cost(std::int64_t fixed_point) {
  if (fixed_point >= kSurelyNoWay) return kNever;
  return static_cast<Time>(std::max<std::int64_t>(0, fixed_point + kScale - 1) / kScale);
}

}  // namespace

// A minimum spanning tree by Prim's algorithm: its weight, and its stops in the order of their
// insertion.
struct OneTreeRelaxation::Tree {
  std::int64_t weight = 0;
  int size = 0;
  std::array<Stop, kMaxTasksPerAgent> stops;
  std::array<Stop, kMaxTasksPerAgent> joined;  // the tree neighbor at insertion
};

// The cheapest pair of a first and a last leg, and their ends in the tree.
struct OneTreeRelaxation::EndLegs {
  std::int64_t cost = 4 * kNoLeg;
  int first = 0;
  int last = 0;
};

OneTreeRelaxation::OneTreeRelaxation(const CostMatrix& matrix)
    : stops_(matrix.stops()),
      ports_(matrix.ports),
      shift_(row_count(), 0),
      symmetric_costs_(stops_ * stops_),
      potential_(stops_, 0),
      weight_(stops_ * stops_) {
  for (int from = 0; from < row_count(); ++from)
    for (int to = 0; to < row_count(); ++to) {
      const Time cost = matrix.between(from, to);
      costs_.push_back(cost >= kNever ? kNoLeg : cost * kScale);
    }
  if (stops_ == 0) {
    root_bound_ = matrix.to_end(0);
  } else {
    shift_legs();
    balance();
    ascend();
  }
}

std::int64_t OneTreeRelaxation::shifted(int from, int to) const {
  const std::int64_t cost = costs_[from * row_count() + to];
  return cost == kNoLeg ? kNoLeg : cost + shift_[from] - shift_[to];
}

void OneTreeRelaxation::shift_legs() {
  const int width = stops_ + 1;
  legs_.assign(row_count() * width, kNoLeg);
  edges_.assign(width * width, kNoLeg);
  for (int from = 0; from < row_count(); ++from)
    for (int to = 0; to < row_count(); ++to) {
      std::int64_t& leg = legs_[from * width + to / ports_];
      leg = std::min(leg, shifted(from, to));
      std::int64_t& edge = edges_[from / ports_ * width + to / ports_];
      edge = std::min(edge, leg);
    }
  for (int i = 0; i < stops_; ++i)
    for (int j = 0; j < stops_; ++j)
      symmetric_costs_[i * stops_ + j] = std::min(edge(i, j), edge(j, i));
}

void OneTreeRelaxation::balance() {
  for (int i = 0; i < stops_; ++i) {
    std::int64_t more = 0;
    std::int64_t pairs = 0;
    for (int j = 0; j < stops_; ++j) {
      if (i == j || edge(i, j) == kNoLeg || edge(j, i) == kNoLeg) continue;
      more += edge(j, i) - edge(i, j);
      ++pairs;
    }
    if (pairs > 0) std::fill_n(&shift_[i * ports_], ports_, more / (2 * pairs));
  }
  shift_legs();
}

void OneTreeRelaxation::update_weights() {
  for (int i = 0; i < stops_; ++i)
    for (int j = 0; j < stops_; ++j)
      weight_[i * stops_ + j] = symmetric_costs_[i * stops_ + j] + potential_[i] + potential_[j];
}

OneTreeRelaxation::Tree OneTreeRelaxation::tree(StopSet left) const {
  Tree tree;
  for_each_stop(left, [&](int stop) { tree.stops[tree.size++] = static_cast<Stop>(stop); });
  // tree.stops[0 .. in_tree-1] are connected. For each other i, edge[i] is the cheapest edge from
  // tree.stops[i] to a connected stop.
  std::array<std::int64_t, kMaxTasksPerAgent> edge;
  const std::int64_t* row = &weight_[tree.stops[0] * stops_];
  for (int i = 1; i < tree.size; ++i) {
    edge[i] = row[tree.stops[i]];
    tree.joined[i] = tree.stops[0];
  }
  for (int in_tree = 1; in_tree < tree.size; ++in_tree) {
    int next = in_tree;
    for (int i = in_tree + 1; i < tree.size; ++i)
      if (edge[i] < edge[next]) next = i;
    GROVE_ASSERT(std::ranges::count(tree.stops.begin(), tree.stops.begin() + in_tree,
                                    tree.joined[next]) == 1,
                 "a stop joins a stop of the tree");
    tree.weight += edge[next];
    std::swap(tree.stops[next], tree.stops[in_tree]);
    std::swap(tree.joined[next], tree.joined[in_tree]);
    edge[next] = edge[in_tree];

    row = &weight_[tree.stops[in_tree] * stops_];
    for (int i = in_tree + 1; i < tree.size; ++i)
      if (const std::int64_t weight = row[tree.stops[i]]; weight < edge[i]) {
        edge[i] = weight;
        tree.joined[i] = tree.stops[in_tree];
      }
  }
  return tree;
}

void OneTreeRelaxation::add_end_legs(Tail& tail, StopSet left) const {
  const auto last_leg = [&](int stop) { return edge(stop, stops_) + potential_[stop]; };
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

OneTreeRelaxation::Tail OneTreeRelaxation::tail(StopSet left) const {
  Tail tail;
  tail.tree = tree(left).weight;
  add_end_legs(tail, left);
  return tail;
}

OneTreeRelaxation::EndLegs OneTreeRelaxation::end_legs(const Tail& tail, StopSet next,
                                                       int from) const {
  EndLegs best;
  for_each_stop(next, [&](int stop) {
    const bool taken = stop == tail.nearest_to_end;
    const std::int64_t cost =
        leg(from, stop) + potential_[stop] + (taken ? tail.second_leg : tail.last_leg);
    if (cost < best.cost) best = {cost, stop, taken ? tail.second_to_end : tail.nearest_to_end};
  });
  return best;
}

Time OneTreeRelaxation::bound(const Tail& tail, StopSet next, int from) const {
  return to_cost(tail.tree + end_legs(tail, next, from).cost - shift_[from]);
}

Time OneTreeRelaxation::bound_from(const Tail& tail, int first) const {
  const int stop = first / ports_;
  return to_cost(tail.tree + potential_[stop] +
                 (stop == tail.nearest_to_end ? tail.second_leg : tail.last_leg) - shift_[first]);
}

// Updates excess.of_port for the two ports of a leg of the relaxed path; `from` and `to` index
// edges_.
void OneTreeRelaxation::count_ports(int from, int to, Excess& excess) const {
  if (ports_ == 1) return;
  const int first = from * ports_;
  const int last = std::min(first + ports_, row_count());
  for (int row = first; row < last; ++row)
    for (int column = to * ports_; column < std::min((to + 1) * ports_, row_count()); ++column)
      if (shifted(row, column) == edge(from, to)) {
        ++excess.of_port[row];
        --excess.of_port[column];
        return;
      }
}

// Returns the bound from the start over all stops, and its subgradient.
std::int64_t OneTreeRelaxation::bound_and_excess(Excess& excess) const {
  const StopSet all = stops_ == 64 ? ~StopSet{0} : bit(stops_) - 1;
  const Tree span = tree(all);
  Tail tail;
  tail.tree = span.weight;
  add_end_legs(tail, all);
  const EndLegs ends = end_legs(tail, all, start_or_end());

  excess.of_stop.assign(stops_, -2);
  excess.of_port.assign(row_count(), 0);
  for (int i = 1; i < span.size; ++i) {
    const int a = span.joined[i];
    const int b = span.stops[i];
    ++excess.of_stop[a];
    ++excess.of_stop[b];
    if (edge(a, b) <= edge(b, a))
      count_ports(a, b, excess);
    else
      count_ports(b, a, excess);
  }
  ++excess.of_stop[ends.first];
  ++excess.of_stop[ends.last];
  count_ports(stops_, ends.first, excess);
  count_ports(ends.last, stops_, excess);
  return tail.tree + ends.cost;
}

// Subgradient ascent with a geometrically decreasing step size; each direction includes a part of
// the last subgradient (Volgenant and Jonker 1982). Any potentials and shifts are sound; the best
// ones are kept.
void OneTreeRelaxation::ascend() {
  Excess excess;
  Excess last;
  update_weights();
  std::vector<std::int64_t> best_potential = potential_;
  std::vector<std::int64_t> best_shift = shift_;
  std::int64_t best = bound_and_excess(last);
  double step = static_cast<double>(best) / (4.0 * stops_);
  const double shrink = step > 1 ? std::pow(1 / step, 1.0 / kSteps) : 1;
  const auto move = [&](std::vector<std::int64_t>& what, const std::vector<int>& now,
                        const std::vector<int>& before, int count, double by) {
    for (int i = 0; i < count; ++i)
      what[i] = std::clamp(what[i] + std::lround(by * (0.7 * now[i] + 0.3 * before[i])),
                           -kMaxPotential, kMaxPotential);
  };
  for (int k = 0; k < kSteps && best < kSurelyNoWay; ++k, step *= shrink) {
    const std::int64_t bound = bound_and_excess(excess);
    if (bound > best) {
      best = bound;
      best_potential = potential_;
      best_shift = shift_;
    }
    const auto none = [](const std::vector<int>& counts) {
      return std::ranges::all_of(counts, [](int count) { return count == 0; });
    };
    if (none(excess.of_stop) && (ports_ == 1 || none(excess.of_port)))
      break;  // the relaxation is a path: the subgradient is 0
    move(potential_, excess.of_stop, last.of_stop, stops_, step);
    if (ports_ > 1) {
      move(shift_, excess.of_port, last.of_port, stops_ * ports_, step);
      shift_legs();
    }
    update_weights();
    std::swap(excess, last);
  }
  potential_ = best_potential;
  shift_ = best_shift;
  shift_legs();
  update_weights();
  GROVE_ASSERT(best >= kSurelyNoWay || bound_and_excess(excess) == best,
               "the stored potentials give the stored bound");
  root_bound_ = to_cost(best);
}

Time relaxation_bound(const CostMatrix& matrix) {
  return OneTreeRelaxation(matrix).root_bound();
}

}  // namespace grove::detail
