// SPDX-License-Identifier: MIT
// One agent that heads for its stops in a given order and counts those it meets before.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grove/search/problem.h"
#include "grove/sequencing/sequence.h"
#include "grove/sequencing/sequence_dag.h"

namespace grove {

// What an agent has still to visit, as numbered states, made when first met. For one thread.
class VisitStates {
 public:
  using State = std::int32_t;

  // `problem` must outlive this. Throws std::invalid_argument if `order` is no complete sequence.
  VisitStates(const Problem& problem, AgentIndex agent, Sequence order);

  // Everything is left but what is on the start.
  State first() { return after(all_, start_); }
  // The state of an agent in `state` once it is on `cell`.
  State after(State state, Cell cell) {
    for (std::size_t stop = 0; stop < cells_.size(); ++stop)
      if (cells_[stop] == cell) return after_stop(state, static_cast<int>(stop));
    return state;
  }

  // Steps from `cell` through all that is left, in order, to where it is to rest; kNever or more
  // when there is no way.
  Time distance(State state, Cell cell) const {
    const Entry& entry = entries_[state];
    return (*entry.to_next)[cell] + entry.onward;
  }

  // May an agent in this state rest on `cell`?
  bool may_rest(State state, Cell cell) const {
    if (entries_[state].left != 0) return false;
    if (destination_) return cell == *destination_;
    for (Cell stop : cells_)
      if (stop == cell) return true;
    return false;
  }

 private:
  struct Entry {
    StopSet left;
    const DistanceField* to_next;  // the first stop left; the place to rest if none is
    Time onward;                   // from there through all others; less than kNever
  };

  State after_stop(State state, int stop) {
    const StopSet left = entries_[state].left & ~(StopSet{1} << stop);
    if (left == entries_[state].left) return state;
    const std::uint32_t known = index_.find(left);
    return known != StopSetIndex::kAbsent ? static_cast<State>(known) : make(left);
  }
  State make(StopSet left);

  Cell start_;
  std::optional<Cell> destination_;
  std::vector<Cell> cells_;  // by stop
  Sequence order_;
  std::vector<const DistanceField*> to_stop_;
  const DistanceField* to_rest_;
  State all_;
  std::vector<Entry> entries_;
  StopSetIndex index_;
};

}  // namespace grove
