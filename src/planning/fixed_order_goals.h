// SPDX-License-Identifier: MIT
// Goals in a fixed order, for safe_interval_search.h.
//
// Progress is the number of goals visited, the last one not counted. Standing on the next goal
// counts as visiting it whenever it happens (at time 0 too, and again if the goal after it is the
// same place): visits are free and having made one takes away no continuation. A goal that takes
// time is visited when its work is completed, and work is begun on the next goal alone: else it
// would be a wait. One path through all
// goals is planned as one path. Planning leg after leg with the earliest arrival of each is neither
// optimal nor complete.
//
// f = t + h, where h = GoalSequence::distance is consistent, and exact without constraints where
// agents turn freely. Two
// prunes, both by the order of goals that every path must keep:
//
// - *Deadlines.* If goal k is barred for ever after time d, a label of progress p <= k is of use
//   only if t + (distance on through goal k) <= d, that is f <= d + after_goal(k). The smallest
//   right side over all k >= p is latest_[p]. That the agent must rest by t (kRestBy) is such a
//   deadline of the last goal: a path of least cost finishes longest_finish() later at most.
//
// - *Gates.* (Agents that turn: g is max_turn_time() later here, see gates.cpp.) Let G be a label
// of
//   goal k just visited, in interval [a, b], reached at time g, and L
//   a label that has yet to visit goal k and cannot do so before g: f(L) >= g + after_goal(k). A
//   path P through L that visits goal k at some time <= b does so at a time in [g, b], where G
//   could stand as well, waiting: from there on P is open to G. Only paths that visit goal k in a
//   later interval, which begins at n, need L, and they cost n + after_goal(k) or more. So L is
//   postponed to that f, and dropped when there is no later interval. Soundness: as long as the
//   finish has not been taken out, some optimal path has an open label that is no later than it
//   on one of its states and has a key (the f it is queued under) of at most the optimal cost. If
//   L is that label and is postponed beyond the optimal cost, then P changes over to G as above:
//   the path through G costs the same, and the first label on it that is not yet expanded has more
//   progress than L had, so this ends. With unconstrained goals (b = kNever) the search thus
//   falls into legs by itself, and it is still exact when it must not.
#pragma once

#include <cstdint>
#include <vector>

#include "planning/goal_sequence.h"
#include "planning/safe_interval_search.h"

namespace grove::detail {

class FixedOrderGoals {
 public:
  using Progress = std::uint8_t;
  static constexpr int kMostGoals = 255;

  // `goals`, 255 at most, must outlive the search. False when there is plainly no path.
  bool assign(const World& world, const GoalSequence& goals, const SafeIntervals& intervals);

  Time first_rest() const { return first_rest_; }
  // What a path costs at least that is in the state at that time.
  Time least_cost(Progress progress, State state, Time time) const {
    return time + stages_[progress].to_goal[state] + stages_[progress].after_goal;
  }
  template <class Reach>
  void on_arrival(Progress progress, State state, Reach reach) const {
    if (world_->is_working(state) && world_->work(state).task != stages_[progress].work) return;
    while (progress < last_progress_ && is_at_goal(progress, state)) ++progress;
    reach(progress);
  }
  Time layer(Progress progress, State state, Time time) const {
    const Time cost = least_cost(progress, state, time);
    return cost > stages_[progress].latest ? kDropped : cost;
  }
  bool may_end(Progress progress, State state) const {
    return progress == last_progress_ && is_at_goal(progress, state);
  }
  Time put_off(Progress progress, State state, Time time, Time layer) const {
    const Stage& stage = stages_[progress];
    if (stage.gate_until <= layer || least_cost(progress, state, time) < stage.gate_from)
      return layer;
    return stage.gate_until < kNever ? stage.gate_until : kDropped;
  }
  bool makes_gate(State state, Progress, Progress progress) const {
    return progress > 0 && is_at_goal(progress - 1, state);
  }
  void close_gate(State state, Progress before, Progress progress, Time time, Time until);

 private:
  // Is the goal after so much progress visited in this state? Most states are no base states on its
  // place, which is known without a look at the distances.
  bool is_at_goal(Progress progress, State state) const {
    const Stage& stage = stages_[progress];
    const auto rank = static_cast<std::uint32_t>(state) - static_cast<std::uint32_t>(stage.first);
    return (rank < stage.states || world_->is_working(state)) && stage.to_goal[state] == 0;
  }

  // What there is to know of one progress.
  struct Stage {
    DistanceView to_goal;  // to the next goal
    State first;           // of the base states on its place
    std::uint32_t states;  // and how many there are
    Time after_goal;
    TaskIndex work;  // the work to be done next; -1: none
    Time latest;     // labels of greater f miss a deadline
    // A label of f >= gate_from need not be looked at before gate_until.
    Time gate_from;
    Time gate_until;
  };

  std::vector<Stage> stages_;  // by progress
  const World* world_ = nullptr;
  int last_progress_ = 0;
  Time turn_about_ = 0;
  Time first_rest_ = 0;
};

}  // namespace grove::detail
