// SPDX-License-Identifier: MIT
// Lower bound on the cost of a path through many stops, from each stop separately.
#pragma once

#include <vector>

#include "model/limits.h"
#include "planning/bucket_queue.h"
#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// For each stop: when can the agent come to rest after visiting this stop? The other stops only
// make it later, so each stop bounds its cost. This takes polynomial time; the question for all
// stops together is NP-hard. It detects the common infeasible case: a door that is closed before or
// behind the agent, for ever or for long.
class SingleStopBound {
 public:
  // Both must outlive this.
  SingleStopBound(const World& world, SafeIntervals& intervals)
      : world_(world), intervals_(intervals) {}

  // Lower bound on the cost of a path through all stops under the intervals, given the bound
  // `known_bound`; kNever if there is no path. If a limit is reached, it examines fewer stops.
  Time min_cost(const AgentStops& stops, Time known_bound, const Limits& limits);

 private:
  using Queue = BasicBucketQueue<std::uint8_t>;  // progress: 1 if `via` was visited

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
  Time after_via_ = 0;  // lower bound on the time from `via` to where the agent may rest
};

}  // namespace grove::detail
