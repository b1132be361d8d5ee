// SPDX-License-Identifier: MIT
// Best member of a sequence class, given exact costs to go. The dynamic programs share this code:
// the prefix of a class leads to a state, and the costs to go complete the sequence from there. For
// matrices with one port per stop.
#pragma once

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// State at the end of the prefix of a class.
struct ClassRoot {
  Time cost = 0;     // of the prefix; kNever if a leg of it has no path
  int last = 0;      // row of the cost matrix: last stop of the prefix, or the start
  StopSet left = 0;  // stops not in the prefix
  StopSet next = 0;  // stops of `left` that may come next
};

inline ClassRoot class_root(const CostMatrix& matrix, const SequenceClass& sequence_class) {
  ClassRoot root{0, matrix.stops(), matrix.all(), 0};
  for (Stop stop : sequence_class.prefix) {
    GROVE_ASSERT((root.left & bit(stop)) != 0, "a prefix does not repeat a stop");
    root.cost = add_costs(root.cost, matrix.between(root.last, stop));
    root.last = stop;
    root.left &= ~bit(stop);
  }
  root.next = root.left & ~sequence_class.forbidden_next;
  return root;
}

// Returns the cost of the cheapest complete sequence of a class; kNever if there is none of finite
// cost. cost_to_go(left, stop): the least cost from `stop` through all stops of `left` to the end.
template <class Completion>
Time best_cost(const CostMatrix& matrix, const ClassRoot& root, const Completion& cost_to_go) {
  if (root.left == 0) return add_costs(root.cost, matrix.to_end(root.last));
  Time best = kNever;
  for_each_stop(root.next, [&](int stop) {
    best = std::min(
        best, add_costs(matrix.between(root.last, stop), cost_to_go(root.left & ~bit(stop), stop)));
  });
  return add_costs(root.cost, best);
}

// Returns a cheapest member of a class; of several, the first one in lexicographic order.
// `cost_to_go` is as for best_cost(). The class must not be empty.
template <class Completion>
Sequence best_member(const CostMatrix& matrix, const SequenceClass& sequence_class,
                     const Completion& cost_to_go) {
  Sequence sequence = sequence_class.prefix;
  for (ClassRoot root = class_root(matrix, sequence_class); root.left != 0;) {
    int best_stop = std::countr_zero(root.next);
    Time best = kNever;
    for_each_stop(root.next, [&](int stop) {
      const Time cost =
          add_costs(matrix.between(root.last, stop), cost_to_go(root.left & ~bit(stop), stop));
      if (cost < best) {
        best = cost;
        best_stop = stop;
      }
    });
    sequence.push_back(static_cast<Stop>(best_stop));
    root.last = best_stop;
    root.left &= ~bit(best_stop);
    root.next = root.left;
  }
  return sequence;
}

}  // namespace grove::detail
