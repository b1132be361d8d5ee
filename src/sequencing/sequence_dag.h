// SPDX-License-Identifier: MIT
// All sequences of one agent up to a given cost, as a directed acyclic graph of states. A state is
// the set of stops left together with the stop on which the agent is. It has one cost for each port
// of that stop (cost_matrix.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/grid.h"
#include "model/limits.h"
#include "sequencing/rtsp.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

class DirectLegs;
class PassedStops;
class OneTreeRelaxation;

// Invariant: all states of every sequence in the scope of the graph that costs less than
// outside_bound() are in the graph, and every state stores its exact cost to go within the graph.
// Immutable: any thread may read it.
class SequenceDag {
 public:
  // An empty graph. `outside_bound` must be a proven lower bound on the cost of every sequence.
  explicit SequenceDag(Time outside_bound)
      : outside_bound_(outside_bound), next_cost_limit_(outside_bound) {}

  // Builds the graph of all sequences of cost <= `cost_limit`. Returns nullopt if a limit was
  // reached.
  static std::optional<SequenceDag> build(const CostMatrix& matrix,
                                          const OneTreeRelaxation& relaxation, Time cost_limit,
                                          const Limits& limits);

  // Selects the contents of a graph.
  struct Scope {
    const CostMatrix& matrix;
    const OneTreeRelaxation& relaxation;
    // If given, the graph holds, for the class `sequence_class`, only the routes of an agent that
    // visits each plain stop that it passes. See "Direct legs" in the .cpp.
    const DirectLegs* direct = nullptr;
    // If given, the graph holds only the canonical sequences of `sequence_class`
    // (passed_stops.cpp). Requires a matrix with one port per stop.
    const PassedStops* passed = nullptr;
    SequenceClass sequence_class =
        {};  // default: all sequences; set it only with `direct` or `passed`
    std::size_t max_states = SIZE_MAX;
  };
  enum class End : std::uint8_t { kBuilt, kStopped, kTooLarge };
  // Builds the graph of `scope` up to cost `cost_limit`. Changes `dag` only if it returns kBuilt.
  static End build(const Scope& scope, Time cost_limit, const Limits& limits, SequenceDag& dag);

  // Proven lower bound on the cost of every sequence in the scope of the graph (with `direct`: of
  // every path of the class) that has a state outside the graph. kNever: there is none.
  Time outside_bound() const { return outside_bound_; }

  // The cost limit to use for the next build, at least outside_bound(). It is chosen to admit about
  // as many new states as the graph has, so that all builds together cost little more than the last
  // one.
  Time next_cost_limit() const { return next_cost_limit_; }

  // The least cost from `port` through all stops of `left` to the end, over routes inside the
  // graph. Returns kNever if there is no such route, or if the state is outside the graph.
  Time cost_to_go(StopSet left, int port) const;

  std::size_t state_count() const { return cost_to_go_.size() / static_cast<std::size_t>(ports_); }

 private:
  template <int kPorts>
  friend class SequenceDagBuilder;

  // The states with the same set `left`: one per stop in `at`, ascending, from index `first` on.
  struct Node {
    StopSet left = 0;
    StopSet at = 0;
    std::uint32_t first = 0;
  };

  int ports_ = 1;
  Time outside_bound_ = 0;
  Time next_cost_limit_ = 0;
  std::vector<Node> nodes_;       // in descending order of |left|
  std::vector<Time> cost_to_go_;  // `ports_` entries per state
  StopSetIndex index_;            // into nodes_
};

}  // namespace grove::detail
