// SPDX-License-Identifier: MIT
// Lower bounds on completing a sequence: spanning trees under node potentials (see the .cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "model/grid.h"
#include "sequencing/stop_set.h"

namespace grove::detail {

// Immutable once built; holds its own copy of the costs.
class OneTreeRelaxation {
 public:
  // What a bound over one set of stops has in common for every stop it may be reached from.
  struct Tail {
    std::int64_t tree = 0;      // all but the first and the last leg
    int nearest_to_end = 0;     // the stop with the cheapest last leg
    int second_to_end = 0;      // the next one; the same if there is no other
    std::int64_t last_leg = 0;  // their last legs
    std::int64_t second_leg = 0;
  };

  // Works on potentials for some 400 spanning trees over all stops.
  explicit OneTreeRelaxation(const CostMatrix& matrix);

  // A proven lower bound on every complete sequence; kNever when there is proven to be none.
  Time root_bound() const { return root_bound_; }

  // Of a set that is not empty. O(|left|^2).
  Tail tail(StopSet left) const;
  // A proven lower bound on the cost from `from` (a row of the matrix) through all stops of the
  // tail to the end when one of `next`, a subset of them, comes first; kNever when there is proven
  // to be no way. O(|next|).
  Time bound(const Tail& tail, StopSet next, int from) const;
  // A proven lower bound on the cost from `first`, a port of a stop of the tail, through its other
  // stops to the end. Weaker than bound() over the others' own tail, which need not be known. O(1).
  Time bound_from(const Tail& tail, int first) const;

 private:
  struct Tree;
  struct EndLegs;
  // Of the relaxed way: at each stop, how many legs touch it less two; at each port, how many begin
  // there less those that end there.
  struct Excess {
    std::vector<int> of_stop;
    std::vector<int> of_port;
  };

  void balance();
  void climb();
  void shift_legs();
  void weigh();
  Tree tree(StopSet left) const;
  void add_end_legs(Tail& tail, StopSet left) const;
  EndLegs end_legs(const Tail& tail, StopSet next, int from) const;
  std::int64_t bound_and_excess(Excess& excess) const;
  void count_ports(int from, int to, Excess& excess) const;

  int row_count() const { return stops_ * ports_ + 1; }
  // The start, as a row; the end, as a column of costs_, not of legs_.
  int start_or_end() const { return stops_ * ports_; }
  std::int64_t shifted(int from, int to) const;
  std::int64_t leg(int from, int to) const { return legs_[from * (stops_ + 1) + to]; }
  std::int64_t edge(int from, int to) const { return edges_[from * (stops_ + 1) + to]; }

  int stops_;
  int ports_;
  std::vector<std::int64_t> costs_;      // in fixed point, as the matrix
  std::vector<std::int64_t> shift_;      // by row of the matrix
  std::vector<std::int64_t> legs_;       // from a row to a stop or the end: least over its ports
  std::vector<std::int64_t> edges_;      // from a stop or the start: least over its ports too
  std::vector<std::int64_t> apart_;      // between two stops, in the cheaper direction
  std::vector<std::int64_t> potential_;  // by stop, in fixed point
  std::vector<std::int64_t> weight_;     // edges between stops, both potentials added
  Time root_bound_ = 0;
};

}  // namespace grove::detail
