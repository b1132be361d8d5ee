// SPDX-License-Identifier: MIT
// All sequences of a class at once, for safe_interval_search.h: progress is a state, what is left
// to visit (free_goals.cpp: touching a stop that may be counted counts it). So the search solves at
// once what the low levels of multi-goal CBS split into orders and paths (MGCBS: Tang et al., IJCAI
// 2024), with the exact cost of completing as heuristic, from the sequence graph.
//
// Heuristic. h(cell, state) = min over the stops u next of dist(cell, u) + completion of the rest
// from u: exact without constraints if the completions know all sequences. Nothing left: the
// distance to the destination, or without one to the nearest stop that may be rested on.
//
// Target reasoning. "Rests on v by t" (kRestBy) leaves one place to rest, and the heuristic is at
// least the distance to it; that it leaves a cutoff of t is the affair of who runs the search.
//
// The cap. Labels of f > cap are dropped, and so are labels in states that the completions do not
// know; is_complete() tells whether there was none. What that proves: free_low_level_search.cpp.
//
// Deadlines. If a stop is barred for ever after time d, a label that has it left is of use only if
// t + dist(cell, stop) <= d.
//
// Gates. A label is put off, or dropped, if others that were expanded on stops stand for its ways
// on (gates.cpp).
//
// Greed. With a weight on the cost to go (Pohl 1970) labels come out in another order; what is
// dropped is dropped by t + h and by gates as before, and neither argument speaks of the order. So
// the first finish is a path within the cap, if perhaps not the cheapest, and what is proven by
// there being none stays proven. No path costs less than the first rest, so f is not taken for less
// here: who has long to wait at its destination is to go there first, not to look at all that can
// be done in the meantime.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "planning/safe_interval_search.h"
#include "planning/sequence_stages.h"
#include "planning/stop_dominance.h"

namespace grove::detail {

class FreeOrderGoals {
 public:
  using Progress = SequenceStages::StageId;

  // `goals` must outlive the search. False when there is plainly no path.
  bool assign(SequenceStages& goals, SafeIntervals& intervals, int inflation_percent);
  // Goes on with the same class over other completions.
  void turn_to(SequenceStages& goals) { goals_ = &goals; }
  SequenceStages& free_goals() const { return *goals_; }

  // Forgets all that was dropped. Dearer labels will be.
  void begin(Time cap);
  // Was nothing dropped that could matter, so that no path found means that there is none?
  bool is_complete() const {
    return !over_ && (!outside_ || goals_->cost_to_go().beyond() == kNever);
  }

  Time first_rest() const { return first_rest_; }
  template <class Reach>
  void on_arrival(Progress stage, State state, Reach reach) {
    if (!goals_->on_arrival(stage, state, reach)) outside_ = true;
  }
  Time layer(Progress stage, State state, Time time) {
    if (!deadlines_.empty() && misses_deadline(stage, state, time)) return kDropped;
    const Time to_go = distance(stage, state);
    if (to_go >= kNever) outside_ = true;
    if (to_go > cap_ - time) {
      over_ |= to_go < kNever;
      return kDropped;
    }
    return layer_of(time + to_go, to_go);
  }
  bool may_end(Progress progress, State state) const {
    const SequenceStages::Stage& stage = goals_->stage(progress);
    return stage.left == 0 && goals_->is_rest(stage, state);
  }
  Time put_off(Progress stage, State state, Time time, Time layer) {
    return gates_.any(stage) ? put_off_by_gates(stage, state, time, layer) : layer;
  }
  bool makes_gate(State, Progress before, Progress progress) const { return before != progress; }
  void close_gate(State state, Progress before, Progress, Time time, Time until) {
    gates_.close(*goals_, before, state, time, until);
  }

 private:
  // A stop that is barred for ever after `time`.
  struct Deadline {
    int stop;
    Time time;
  };

  void find_deadlines(const SafeIntervals& intervals);
  void find_rests(const SafeIntervals& intervals);
  bool misses_deadline(Progress stage, State state, Time time) const;
  Time put_off_by_gates(Progress stage, State state, Time time, Time layer);
  // At most what a path from here on costs.
  Time distance(Progress stage, State state) const {
    const Time distance = goals_->distance(stage, state);
    if (only_rest_ == AgentStops::kNoStop) return distance;
    return std::max(distance, goals_->stops().distance(state, only_rest_));
  }
  Time layer_of(Time least_cost, Time to_go) const {
    if (greed_percent_ == 0) return least_cost;
    return std::max(least_cost, first_rest_) +
           static_cast<Time>(std::int64_t{to_go} * greed_percent_ / 100);
  }

  SequenceStages* goals_ = nullptr;
  int greed_percent_ = 0;
  std::vector<Deadline> deadlines_;
  Time first_rest_ = 0;
  int only_rest_ = AgentStops::kNoStop;  // without a destination: the only stop to rest on, perhaps
  StopDominance gates_;
  Time cap_ = 0;
  bool over_ = false;     // a label was dropped for the cap
  bool outside_ = false;  // one was whose state the completions do not know
};

}  // namespace grove::detail
