// SPDX-License-Identifier: MIT
// All sequences of a class at once, for safe_interval_search.h. Progress is a stage: what is left
// to visit (sequence_stages.cpp: visiting a stop that may be counted counts it). So one search
// solves what the low levels of multi-goal CBS split into orders and paths (MGCBS: Tang et al.,
// IJCAI 2024). The heuristic is the exact cost to go from the sequence graph.
//
// *Heuristic.* h(state) = minimum over the stops u that may be next of dist(state, u) + cost to go
// from u. It is exact without constraints if the costs to go cover all sequences. If nothing is
// left, h is the distance to the destination, or without one to the nearest stop where the agent
// may rest.
//
// *Target reasoning.* "Rests on v by t" (kRestBy) leaves one place to rest, and the heuristic is at
// least the distance to it. The cutoff of t that it implies is applied by the caller of the search.
//
// *Cap.* Labels of f > cap are dropped, and also labels in stages that the costs to go do not
// cover. is_complete() returns whether no such label was dropped. What that proves:
// free_order_sipp.cpp.
//
// *Deadlines.* If a stop is barred for ever after time d, a label that has this stop left is of use
// only if t + dist(state, stop) <= d.
//
// *Gates.* A label is postponed, or dropped, if labels that were expanded on stops dominate it for
// all its continuations (stop_dominance.cpp).
//
// *Inflation.* With a weight on the cost to go (weighted A*: Pohl 1970) labels are popped in
// another order. Labels are still dropped by t + h and by gates, and neither argument depends on
// the order. So the first finish is a path within the cap, but perhaps not the cheapest, and a
// proof that there is none remains valid. No path costs less than the first rest, so f is raised to
// it here. Thus an agent that has to wait long at its destination goes there first, and the search
// does not expand everything that can be done in the meantime.
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

  // `goals` must outlive the search. Returns false if a quick test proves that there is no path.
  bool assign(SequenceStages& goals, SafeIntervals& intervals, int inflation_percent);
  // Continues with the same class over other costs to go.
  void set_stages(SequenceStages& goals) { goals_ = &goals; }
  SequenceStages& stages() const { return *goals_; }

  // Starts a search that drops labels of f > cap. Resets is_complete() and the gates.
  void begin(Time cap);
  // Was no label dropped that could matter? Then "no path found" proves that there is none.
  bool is_complete() const {
    return !dropped_by_cap_ &&
           (!dropped_uncovered_ || goals_->cost_to_go().outside_bound() == kNever);
  }

  Time first_rest() const { return first_rest_; }
  template <class Reach>
  void on_arrival(Progress stage, State state, Reach reach) {
    if (!goals_->on_arrival(stage, state, reach)) dropped_uncovered_ = true;
  }
  Time layer(Progress stage, State state, Time time) {
    if (!deadlines_.empty() && misses_deadline(stage, state, time)) return kDropped;
    const Time to_go = distance(stage, state);
    if (to_go >= kNever) dropped_uncovered_ = true;
    if (to_go > cap_ - time) {
      dropped_by_cap_ |= to_go < kNever;
      return kDropped;
    }
    return layer_of(time + to_go, to_go);
  }
  bool may_end(Progress progress, State state) const {
    const SequenceStages::Stage& stage = goals_->stage(progress);
    return stage.left == 0 && goals_->is_rest(stage, state);
  }
  Time postponed_layer(Progress stage, State state, Time time, Time layer) {
    return gates_.any(stage) ? postponed_layer_by_gates(stage, state, time, layer) : layer;
  }
  bool can_be_gate(State, Progress before, Progress progress) const { return before != progress; }
  void add_gate(State state, Progress before, Progress, Time time, Time until) {
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
  Time postponed_layer_by_gates(Progress stage, State state, Time time, Time layer);
  // Lower bound on the cost of a path from here on.
  Time distance(Progress stage, State state) const {
    const Time distance = goals_->distance(stage, state);
    if (only_rest_ == AgentStops::kNoStop) return distance;
    return std::max(distance, goals_->stops().distance(state, only_rest_));
  }
  Time layer_of(Time min_cost, Time to_go) const {
    if (inflation_percent_ == 0) return min_cost;
    return std::max(min_cost, first_rest_) +
           static_cast<Time>(std::int64_t{to_go} * inflation_percent_ / 100);
  }

  SequenceStages* goals_ = nullptr;
  int inflation_percent_ = 0;
  std::vector<Deadline> deadlines_;
  Time first_rest_ = 0;
  int only_rest_ = AgentStops::kNoStop;  // without a destination: the stop of kRestBy
  StopDominance gates_;
  Time cap_ = 0;
  bool dropped_by_cap_ = false;  // a label was dropped by the cap
  bool dropped_uncovered_ =
      false;  // a label was dropped because the costs to go do not cover its stage
};

}  // namespace grove::detail
