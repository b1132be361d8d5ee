// SPDX-License-Identifier: MIT
#include "planning/free_order_goals.h"

namespace grove::detail {

bool FreeOrderGoals::assign(SequenceStages& goals, SafeIntervals& intervals,
                            int inflation_percent) {
  goals_ = &goals;
  inflation_percent_ = inflation_percent;
  const AgentStops& stops = goals.stops();
  intervals.ensure_intervals(stops.start_place());
  if (stops.destination()) intervals.ensure_intervals(*stops.destination());
  for (int stop = 0; stop < stops.count(); ++stop) intervals.ensure_intervals(stops.place(stop));
  find_deadlines(intervals);
  find_rests(intervals);
  return first_rest_ < kNever && first_rest_ <= intervals.latest_rest() && goals.plausible();
}

void FreeOrderGoals::find_deadlines(const SafeIntervals& intervals) {
  const AgentStops& stops = goals_->stops();
  deadlines_.clear();
  for (int stop = 0; stop < stops.count(); ++stop) {
    const Time last = intervals.last_time(stops.place(stop));
    if (last < kNever) deadlines_.push_back({stop, last});
  }
}

// Computes the first time at which the agent may come to rest forever on any of its places of rest.
// If it rests on its last stop, also finds the stop on which a constraint forces it to rest. (With
// a destination the heuristic already leads there.)
void FreeOrderGoals::find_rests(const SafeIntervals& intervals) {
  const AgentStops& stops = goals_->stops();
  only_rest_ = AgentStops::kNoStop;
  first_rest_ = stops.destination() ? intervals.rest_begin(*stops.destination()) : kNever;
  if (stops.destination()) return;
  if (stops.count() == 0) first_rest_ = 0;  // it may rest anywhere
  for (int stop = 0; stop < stops.count(); ++stop) {
    first_rest_ = std::min(first_rest_, intervals.rest_begin(stops.place(stop)));
    if (stops.rests_on_last_stop() && stops.place(stop) == intervals.only_rest()) only_rest_ = stop;
  }
}

void FreeOrderGoals::begin(Time cap) {
  cap_ = cap;
  dropped_by_cap_ = dropped_uncovered_ = false;
  gates_.begin_search();
}

bool FreeOrderGoals::misses_deadline(Progress stage, State state, Time time) const {
  const AgentStops& stops = goals_->stops();
  const StopSet left = goals_->stage(stage).left;
  return std::ranges::any_of(deadlines_, [&](const Deadline& d) {
    return (left >> d.stop & 1) != 0 && time + stops.distance(state, d.stop) > d.time;
  });
}

Time FreeOrderGoals::postponed_layer_by_gates(Progress id, State state, Time time, Time layer) {
  const Time until = gates_.min_cost(*goals_, id, state, time);
  Time postponed_layer = kDropped;
  if (until > cap_) {
    dropped_by_cap_ |= until < kNever;
  } else {
    postponed_layer = layer_of(until, inflation_percent_ == 0 ? 0 : goals_->distance(id, state));
    if (postponed_layer <= layer) return layer;
  }
  const SequenceStages::Stage& stage = goals_->stage(id);
  if (std::popcount(stage.next) * goals_->stops().ports() != stage.count) dropped_uncovered_ = true;
  return postponed_layer;
}

}  // namespace grove::detail
