// SPDX-License-Identifier: MIT
// Goals of a safe-interval search (safe_interval_search.h) over all sequences of a class at once.
// Progress is a stage, which is the set of stops left to visit (sequence_stages.cpp). One search
// therefore finds the order and the path, which the low level of multi-goal CBS computes separately
// (MGCBS: Tang et al., IJCAI 2024). The heuristic is the exact cost to go from the sequence graph.
//
// *Heuristic.* h(state) = minimum over the stops u that may be next of dist(state, u) + cost to go
// from u. It is exact without constraints if the costs to go cover all sequences. If no stop is
// left, h is the distance to the nearest state in which the agent may rest.
//
// *Target reasoning.* A constraint to rest on v by t (kRestBy) leaves v as the only place of rest.
// If the agent rests on its last stop, the heuristic is at least the distance to v. FreeOrderSipp
// applies the cutoff that the constraint implies.
//
// *Cap.* Labels of f > cap are dropped, and so are labels in stages that the costs to go do not
// cover. is_complete() returns false if a dropped label could have led to a path. The head of
// free_order_sipp.cpp states what each result proves.
//
// *Deadlines.* If a stop is barred forever after time d, a label that has this stop left can lead
// to a path only if t + dist(state, stop) <= d.
//
// *Gates.* Labels that were expanded on stops dominate continuations of other labels
// (stop_dominance.cpp). A label is postponed to the least f of a continuation that is not
// dominated, and dropped if there is none.
//
// *Inflation.* With a weight on the cost to go (weighted A*: Pohl 1970) labels are popped in a
// different order. Labels are still dropped by t + h and by gates, and neither argument depends on
// the order. Therefore the first finish is a path within the cap, perhaps not a cheapest one, and a
// proof that no path exists remains valid. No path costs less than the first rest, so with a weight
// f is raised to it. As a result, an agent that must wait long for its place of rest goes there
// first, and the search does not expand all labels that are possible during the wait.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "planning/safe_interval_search.h"
#include "planning/sequence_stages.h"
#include "planning/stop_dominance.h"

namespace grove::detail {

// Goals of one sequence class, as template argument of SafeIntervalSearch. One thread at a time.
class FreeOrderGoals {
 public:
  using Progress = SequenceStages::StageId;

  // `goals` must outlive the search. Returns false if a quick test proves that there is no path.
  bool assign(SequenceStages& goals, SafeIntervals& intervals, int inflation_percent);
  // Replaces the stages by `goals`, which has the same class but different costs to go.
  void set_stages(SequenceStages& goals) { goals_ = &goals; }
  SequenceStages& stages() const { return *goals_; }

  // Starts a search that drops labels of f > cap. Resets is_complete() and the gates.
  void begin(Time cap);
  // True if no dropped label could have led to a path. Then a search without result proves that no
  // path exists.
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
  // A stop that is barred forever after `time`.
  struct Deadline {
    int stop;
    Time time;
  };

  void find_deadlines(const SafeIntervals& intervals);
  void find_rests(const SafeIntervals& intervals);
  bool misses_deadline(Progress stage, State state, Time time) const;
  Time postponed_layer_by_gates(Progress stage, State state, Time time, Time layer);
  // Lower bound on the steps from the state to the finish.
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
  // If the agent rests on its last stop: the only stop on which it may rest (kRestBy).
  int only_rest_ = AgentStops::kNoStop;
  StopDominance gates_;
  Time cap_ = 0;
  bool dropped_by_cap_ = false;  // a label was dropped by the cap
  // A continuation that the costs to go do not cover may have been dropped.
  bool dropped_uncovered_ = false;
};

}  // namespace grove::detail
