// SPDX-License-Identifier: MIT
// All sequences of one agent up to a cost, as a graph of states: what is left to visit, and the
// stop where the agent stands; each with a cost for each port of that stop (cost_matrix.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/grid.h"
#include "model/limits.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence.h"

namespace grove::detail {

class DirectLegs;
class PassedStops;
class OneTreeRelaxation;

// Maps sets to numbers: open addressing, linear probing.
class StopSetIndex {
 public:
  static constexpr std::uint32_t kAbsent = UINT32_MAX;

  StopSetIndex() : slots_(16) {}
  std::uint32_t find(StopSet set) const { return slots_[slot_of(set)].number; }
  std::size_t bytes() const { return slots_.size() * sizeof(Slot); }
  // The number of `set`; if it had none, `number`, which it now has.
  std::uint32_t insert(StopSet set, std::uint32_t number);

 private:
  struct Slot {
    StopSet set = 0;
    std::uint32_t number = kAbsent;
  };

  std::size_t slot_of(StopSet set) const;
  void grow();

  std::vector<Slot> slots_;  // a power of two, at most half full
  std::size_t used_ = 0;
};

// Every sequence cheaper than beyond() runs through states of the graph alone, and every state
// knows its exact cost to go within the graph. Immutable once built; any thread may read it.
class SequenceDag {
 public:
  // No state at all; `beyond` must be a proven lower bound on every sequence.
  explicit SequenceDag(Time beyond) : beyond_(beyond), next_reach_(beyond) {}

  // With every sequence of cost <= reach. Returns nullopt if a limit was reached.
  static std::optional<SequenceDag> build(const CostMatrix& matrix,
                                          const OneTreeRelaxation& relaxation, Time reach,
                                          const Limits& limits);

  // What is in a graph.
  struct Scope {
    const CostMatrix& matrix;
    const OneTreeRelaxation& relaxation;
    // If given, only the ways of an agent that visits each plain stop of `work` that it passes, and
    // what these cost: see the .cpp.
    const DirectLegs* direct = nullptr;
    // If given, only the canonical sequences of `work` (passed_stops.cpp); for matrices with one
    // port a stop.
    const PassedStops* passed = nullptr;
    SequenceClass work = {};  // all sequences, unless there is `direct` or `passed`
    std::size_t most_states = SIZE_MAX;
  };
  enum class End : std::uint8_t { kBuilt, kStopped, kTooLarge };
  // The same within a scope. Changes `dag` only if it was built.
  static End build(const Scope& scope, Time reach, const Limits& limits, SequenceDag& dag);

  // Proven: a sequence with a state outside the graph costs at least this. kNever: no such one.
  Time beyond() const { return beyond_; }

  // The reach to build with next, at least beyond(): lets in about as many states as there are, so
  // that building again and again costs little more than the last build alone.
  Time next_reach() const { return next_reach_; }

  // The least cost from a port through all of `left` to the end, over the ways inside the graph;
  // kNever when there is none, or the state is outside.
  Time cost_to_go(StopSet left, int port) const;

  std::size_t state_count() const { return completions_.size() / static_cast<std::size_t>(ports_); }

 private:
  template <int kPorts>
  friend class SequenceDagBuilder;

  // The states that share what is left; one for each stop in `at`, ascending, from `first` on.
  struct Node {
    StopSet left = 0;
    StopSet at = 0;
    std::uint32_t first = 0;
  };

  int ports_ = 1;
  Time beyond_ = 0;
  Time next_reach_ = 0;
  std::vector<Node> nodes_;        // sets in descending order of size
  std::vector<Time> completions_;  // of each state, as many as ports
  StopSetIndex index_;             // into nodes_
};

}  // namespace grove::detail
