// SPDX-License-Identifier: MIT
// 1-tree lower bounds on the cost of completing a sequence: spanning trees under node potentials
// (Held and Karp 1970; see the .cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "model/grid.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Holds its own copy of the costs. Immutable: any thread may read it.
class OneTreeRelaxation {
 public:
  // The part of a bound over one set of stops that does not depend on the stop from which the agent
  // comes.
  struct Tail {
    std::int64_t tree = 0;   // the bound without the first and the last leg, in fixed point
    int nearest_to_end = 0;  // the stop with the cheapest last leg
    int second_to_end = 0;   // the stop with the next cheapest one; nearest_to_end if it is alone
    std::int64_t last_leg = 0;    // cost of the last leg from nearest_to_end, in fixed point
    std::int64_t second_leg = 0;  // the same from second_to_end
  };

  // Optimizes the potentials in at most 400 iterations, each with a spanning tree over all stops.
  explicit OneTreeRelaxation(const CostMatrix& matrix);

  // A proven lower bound on the cost of every complete sequence. kNever: proven that none exists.
  Time root_bound() const { return root_bound_; }

  // Returns the tail of `left`, which must not be empty. O(|left|^2).
  Tail tail(StopSet left) const;
  // Returns a proven lower bound on the cost from `from` (a row of the matrix) through all stops of
  // the tail to the end, with a stop of `next`, a subset of these stops, as the first one. kNever:
  // proven that no such route exists. O(|next|).
  Time bound(const Tail& tail, StopSet next, int from) const;
  // Returns a proven lower bound on the cost from `first`, a port of a stop of the tail, through
  // the other stops of the tail to the end. Weaker than bound() over the tail of the other stops,
  // but does not require that tail. O(1).
  Time bound_from(const Tail& tail, int first) const;

 private:
  struct Tree;
  struct EndLegs;
  // Subgradient at the relaxed path. of_stop: number of legs at each stop, minus two. of_port:
  // number of legs that leave each port, minus the number that enter it.
  struct Excess {
    std::vector<int> of_stop;
    std::vector<int> of_port;
  };

  void balance();
  void ascend();
  void shift_legs();
  void update_weights();
  Tree tree(StopSet left) const;
  void add_end_legs(Tail& tail, StopSet left) const;
  EndLegs end_legs(const Tail& tail, StopSet next, int from) const;
  std::int64_t bound_and_excess(Excess& excess) const;
  void count_ports(int from, int to, Excess& excess) const;

  int row_count() const { return stops_ * ports_ + 1; }
  // Index of the start as a row of costs_ and legs_, and of the end as a column of costs_.
  int start_or_end() const { return stops_ * ports_; }
  std::int64_t shifted(int from, int to) const;
  std::int64_t leg(int from, int to) const { return legs_[from * (stops_ + 1) + to]; }
  std::int64_t edge(int from, int to) const { return edges_[from * (stops_ + 1) + to]; }

  int stops_;
  int ports_;
  std::vector<std::int64_t> costs_;            // in fixed point, laid out as the matrix
  std::vector<std::int64_t> shift_;            // by row of the matrix
  std::vector<std::int64_t> legs_;             // from a row to a stop or the end: least over ports
  std::vector<std::int64_t> edges_;            // also least over the ports of the first stop
  std::vector<std::int64_t> symmetric_costs_;  // between two stops, in the cheaper direction
  std::vector<std::int64_t> potential_;        // by stop, in fixed point
  std::vector<std::int64_t> weight_;           // symmetric_costs_ plus the potentials of both stops
  Time root_bound_ = 0;
};

}  // namespace grove::detail
