// SPDX-License-Identifier: MIT
// A quick necessary condition for a path through many cells.
#pragma once

#include <vector>

#include "model/limits.h"
#include "planning/bucket_queue.h"
#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// When can an agent come to rest, having been on one of its stops? What it must visit besides only
// makes it later: so each stop bounds its cost. Polynomial where the question for all stops
// together is not: it settles the common hopeless case, a door shut before or behind the agent, for
// ever or for long.
class SingleStopBound {
 public:
  // Both must outlive this.
  SingleStopBound(const World& world, SafeIntervals& intervals)
      : world_(world), intervals_(intervals) {}

  // What a path through all stops costs at least under the intervals, `least` being known; kNever:
  // there is none. Looks at fewer of them if a limit strikes.
  Time least_cost(const AgentStops& stops, Time least, const Limits& limits);

 private:
  using Queue = BasicBucketQueue<std::uint8_t>;  // progress: has been on `via`

  static std::size_t index(int slot, int visited) {
    return 2 * static_cast<std::size_t>(slot) + static_cast<std::size_t>(visited);
  }
  Time least_cost_through(int via);
  Time to_go(State state, bool visited) const;
  bool may_rest(int slot) const;
  void reach(int slot, State state, Time time, bool visited);

  const World& world_;
  SafeIntervals& intervals_;
  Queue queue_;
  std::vector<Time> earliest_;  // by slot, then progress
  const AgentStops* stops_ = nullptr;
  int via_ = AgentStops::kNoStop;
  Time least_ = 0;
  Time after_via_ = 0;  // from there to where the agent may rest, at least
};

}  // namespace grove::detail
