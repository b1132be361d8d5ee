// SPDX-License-Identifier: MIT
// Lower bound on the cost of a path through many stops, computed for each stop separately.
#pragma once

#include <vector>

#include "model/limits.h"
#include "planning/bucket_queue.h"
#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Computes for each stop the earliest time at which the agent can come to rest after visiting this
// stop. The other stops only make that time later, so it is a lower bound on the cost. This takes
// polynomial time, whereas the problem for all stops together is NP-hard. The bound detects the
// most common infeasible case: a door that is closed before or behind the agent, forever or for a
// long time. One thread at a time.
class SingleStopBound {
 public:
  // `world` and `intervals` must outlive this object.
  SingleStopBound(const World& world, SafeIntervals& intervals)
      : world_(world), intervals_(intervals) {}

  // Returns a lower bound on the cost of a path through all stops under the intervals, at least the
  // known lower bound `known_bound`; kNever: proven that no path exists. If a limit is reached, it
  // examines fewer stops.
  Time min_cost(const AgentStops& stops, Time known_bound, const Limits& limits);

 private:
  using Queue = BasicBucketQueue<std::uint8_t>;  // progress: 1 if via_ was visited

  static std::size_t index(int slot, int visited) {
    return 2 * static_cast<std::size_t>(slot) + static_cast<std::size_t>(visited);
  }
  Time min_cost_through(int via);
  Time to_go(State state, bool visited) const;
  bool may_rest(int slot) const;
  void reach(int slot, State state, Time time, bool visited);

  const World& world_;
  SafeIntervals& intervals_;
  Queue queue_;
  std::vector<Time> earliest_;  // by slot, then progress
  const AgentStops* stops_ = nullptr;
  int via_ = AgentStops::kNoStop;
  Time bound_ = 0;
  Time after_via_ = 0;  // lower bound on the steps from via_ to a state of rest
};

}  // namespace grove::detail
