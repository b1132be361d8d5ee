// SPDX-License-Identifier: MIT
// Sequences of an agent that may leave out stops at a price, as a directed acyclic graph of states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/grid.h"
#include "model/limits.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/sequence.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// The price of leaving out all stops of `set`; kNever if the agent must visit one of them.
// `skip`: by stop, the price of leaving it out, or kNever.
Time price_without(const std::vector<Time>& skip, StopSet set);

// Lower bounds on the price from a stop to the end (ng_walks.h). Immutable: any thread may read it.
class CompletionBounds {
 public:
  // Requires one port per stop. `neighborhoods`: by stop, the stops that a walk remembers there at
  // first; empty: those nearby. Returns nullopt if there is no bound, or if a limit was reached.
  static std::optional<CompletionBounds> make(const CostMatrix& matrix,
                                              const std::vector<Time>& skip,
                                              const std::vector<StopSet>& neighborhoods,
                                              const Limits& limits);
  // The bound from `stop`, if the stops of `left` are not visited yet; at most kNever.
  Time from(int stop, StopSet left) const;

 private:
  // A reverse walk: its cost minus the prizes of the stops after the one where it begins, and its
  // visits that it remembers.
  struct Completion {
    std::int64_t cost;
    StopSet required;
    StopSet others;
  };
  StopSet required_ = 0;  // stops that walks always remember
  std::vector<Time> skip_;
  std::vector<std::vector<Completion>> completions_;  // by stop, in ascending order of cost
};

// A state is the set of stops left, of which any may be left out at the end, together with the stop
// on which the agent is. Invariant: all states of every sequence of a price below outside_bound()
// are in the graph, and every state stores its exact price to go within the graph. Immutable: any
// thread may read it.
class OptionalStopsDag {
 public:
  static constexpr std::size_t kMaxStates = std::size_t{1} << 17;

  // An empty graph. `outside_bound`: a proven lower bound on the price of every sequence that
  // visits a stop.
  explicit OptionalStopsDag(Time outside_bound) : outside_bound_(outside_bound) {}
  // The graph of all sequences of a price <= `limit`. Returns nullopt if it would have more than
  // kMaxStates states, or if a limit was reached.
  static std::optional<OptionalStopsDag> build(const CostMatrix& matrix,
                                               const std::vector<Time>& skip,
                                               const CompletionBounds& bounds, Time limit,
                                               const Limits& limits);

  // Proven lower bound on the price of every sequence with a state outside the graph.
  Time outside_bound() const { return outside_bound_; }
  // The least price from `stop` to the end, through some of the stops of `left`, plus the prices of
  // the others. Returns kNever if the state is outside the graph.
  Time price_to_go(StopSet left, int stop) const;

 private:
  // The states with the same set `left`: one per stop in `at`, ascending, from index `first` on.
  struct Node {
    StopSet left = 0;
    StopSet at = 0;
    std::uint32_t first = 0;
  };

  Time outside_bound_;
  std::vector<Node> nodes_;  // in descending order of |left|
  std::vector<Time> price_to_go_;
  StopSetIndex index_;  // into nodes_
};

}  // namespace grove::detail
