// SPDX-License-Identifier: MIT
// Goals in a fixed order, for safe_interval_search.h.
//
// *Progress* is the number of goals visited, the last one not counted. Standing on the next goal
// counts as visiting it whenever it happens (at time 0 too, and again if the goal after it is the
// same place): visits are free, and a visit made removes no continuation. A goal that takes time is
// visited when its work is completed. Work is begun only on the next goal; otherwise it would be
// equivalent to waiting. One path through all goals is planned as one path, because planning leg by
// leg with the earliest arrival of each is neither optimal nor complete.
//
// *Heuristic.* f = t + h, where h = GoalSequence::distance is consistent, and exact without
// constraints if agents turn freely.
//
// Two pruning rules follow from the order of goals that every path must keep:
//
// *Deadlines.* If goal k is barred for ever after time d, a label of progress p <= k is of use only
// if t + (distance on through goal k) <= d, that is f <= d + after_goal(k). Stage::latest of
// progress p is the smallest right side over all k >= p. The constraint that the agent must rest by
// t (kRestBy) is such a deadline of the last goal: a path of least cost finishes at most
// longest_finish() later.
//
// *Gates.* Let G be a label of goal k just visited, in interval [a, b], reached at time g. (If
// agents turn, g is max_turn_time() later here; see stop_dominance.cpp.) Let L be a label that
// has yet to visit goal k and cannot do so before g: f(L) >= g + after_goal(k). A path P through L
// that visits goal k at some time <= b does so at a time in [g, b]. G could stand there then as
// well, waiting, and from there on P is open to G. So L is needed only for paths that visit goal k
// in a later interval, which begins at n, and they cost n + after_goal(k) or more. So L is
// postponed to that f, and dropped if there is no later interval. *Claim: the rule loses no optimal
// path.* *Proof.* As long as the finish has not been popped, some optimal path has an open label
// that is no later than the path on one of its states and has a key (the f under which it is
// queued) of at most the optimal cost. If L is that label and is postponed beyond the optimal cost,
// then P changes over to G as above. The path through G costs the same, and the first label on it
// that is not yet expanded has more progress than L had, so this ends. *Consequence.* With
// unconstrained goals (b = kNever) the search decomposes into legs by itself. It remains exact if
// the goals are constrained.
#pragma once

#include <cstdint>
#include <vector>

#include "planning/goal_sequence.h"
#include "planning/safe_interval_search.h"

namespace grove::detail {

class FixedOrderGoals {
 public:
  using Progress = std::uint8_t;
  static constexpr int kMaxGoals = 255;

  // `goals` must outlive the search and have at most 255 goals. Returns false if a quick test
  // proves that there is no path.
  bool assign(const World& world, const GoalSequence& goals, const SafeIntervals& intervals);

  Time first_rest() const { return first_rest_; }
  // Lower bound on the cost of a path that is in the state at `time` with this progress.
  Time min_cost(Progress progress, State state, Time time) const {
    return time + stages_[progress].to_goal[state] + stages_[progress].after_goal;
  }
  template <class Reach>
  void on_arrival(Progress progress, State state, Reach reach) const {
    if (world_->is_working(state) && world_->work(state).task != stages_[progress].work) return;
    while (progress < last_progress_ && is_at_goal(progress, state)) ++progress;
    reach(progress);
  }
  Time layer(Progress progress, State state, Time time) const {
    const Time cost = min_cost(progress, state, time);
    return cost > stages_[progress].latest ? kDropped : cost;
  }
  bool may_end(Progress progress, State state) const {
    return progress == last_progress_ && is_at_goal(progress, state);
  }
  Time postponed_layer(Progress progress, State state, Time time, Time layer) const {
    const Stage& stage = stages_[progress];
    if (stage.gate_until <= layer || min_cost(progress, state, time) < stage.gate_from)
      return layer;
    return stage.gate_until < kNever ? stage.gate_until : kDropped;
  }
  bool can_be_gate(State state, Progress, Progress progress) const {
    return progress > 0 && is_at_goal(progress - 1, state);
  }
  void add_gate(State state, Progress before, Progress progress, Time time, Time until);

 private:
  // Is the next goal after `progress` visited in this state? Most states are not base states on the
  // goal's place, which is tested without access to the distances.
  bool is_at_goal(Progress progress, State state) const {
    const Stage& stage = stages_[progress];
    const auto rank = static_cast<std::uint32_t>(state) - static_cast<std::uint32_t>(stage.first);
    return (rank < stage.states || world_->is_working(state)) && stage.to_goal[state] == 0;
  }

  // Data of one progress.
  struct Stage {
    DistanceView to_goal;  // distances to the next goal
    State first;           // the first of the base states on its place
    std::uint32_t states;  // and their number
    Time after_goal;
    TaskIndex work;  // the task whose work is next; -1: none
    Time latest;     // labels of greater f miss a deadline
    // A label of f >= gate_from is postponed to layer gate_until; kNever: it is dropped.
    Time gate_from;
    Time gate_until;
  };

  std::vector<Stage> stages_;  // by progress
  const World* world_ = nullptr;
  int last_progress_ = 0;
  Time max_turn_time_ = 0;
  Time first_rest_ = 0;
};

}  // namespace grove::detail
