// SPDX-License-Identifier: MIT
// Goals of a safe-interval search (safe_interval_search.h) in a fixed order.
//
// *Progress* is the number of visited goals, not counting the last goal. An agent on its next goal
// always visits it, also at time 0, and also the goal after it if that is the same place: a visit
// costs nothing and removes no continuation. A goal that takes time is visited when its task
// execution ends. The agent starts an execution only on its next goal; any other execution would be
// equivalent to waiting. One search plans all legs together, because planning leg by leg with the
// earliest arrival at each goal is neither optimal nor complete.
//
// *Heuristic.* f = t + h, where h = GoalSequence::distance is consistent, and exact without
// constraints if agents turn freely.
//
// Two pruning rules use the fixed order of the goals:
//
// *Deadlines.* If goal k is barred forever after time d, a label of progress p <= k can lead to a
// path only if t + (distance through goals p to k) <= d, that is, f <= d + after_goal(k).
// Stage::latest of progress p is the least d + after_goal(k) over all k >= p. A constraint that the
// agent must rest by time r (kRestBy) also limits f, to r + longest_finish(), because a path of
// least cost finishes at most longest_finish() after its last arrival.
//
// *Gates.* Let G be a label that has just visited goal k, at time g in the interval [a, b]. (If
// agents turn, g is max_turn_time() later here; see stop_dominance.cpp.) Let L be a label that has
// not visited goal k and cannot visit it before g: f(L) >= g + after_goal(k). If a path P through L
// visits goal k at time b or earlier, this time is in [g, b]. The agent of G can wait on goal k
// until then and continue like P. Therefore L is needed only for paths that visit goal k in a later
// interval. If the next interval begins at n, these paths cost n + after_goal(k) or more, and L is
// postponed to that f. If there is no later interval, L is dropped.
// *Claim: the rule loses no optimal path.* *Proof.* Until the finish is popped, some optimal path P
// has an open label that reaches one of the states of P no later than P does and whose key (the f
// under which it is queued) is at most the optimal cost. If this label is L and is postponed beyond
// the optimal cost, P can be replaced by a path through G as above. That path costs the same, and
// its first unexpanded label has more progress than L, so only finitely many replacements follow.
// *Consequence.* If no goal is constrained (b = kNever), the search decomposes into legs without
// further rules. It remains exact if goals are constrained.
#pragma once

#include <cstdint>
#include <vector>

#include "planning/goal_sequence.h"
#include "planning/safe_interval_search.h"

namespace grove::detail {

// Goals of one GoalSequence, as template argument of SafeIntervalSearch. One thread at a time.
class FixedOrderGoals {
 public:
  using Progress = std::uint8_t;
  static constexpr int kMaxGoals = 255;

  // Sets the goals, at most kMaxGoals. Labels of f > `cutoff` are dropped.
  // `world` and the distance fields of `goals` must outlive the search. Returns false if a quick
  // test proves that there is no path.
  bool assign(const World& world, const GoalSequence& goals, SafeIntervals& intervals, Time cutoff);

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
  // Does an agent of this progress visit its next goal in this state? Most states are neither base
  // states on the place of the goal nor states of work, so the test seldom reads the distances.
  bool is_at_goal(Progress progress, State state) const {
    const Stage& stage = stages_[progress];
    const auto rank = static_cast<std::uint32_t>(state) - static_cast<std::uint32_t>(stage.first);
    return (rank < stage.states || world_->is_working(state)) && stage.to_goal[state] == 0;
  }

  // Data for one value of progress.
  struct Stage {
    DistanceView to_goal;  // distances to the next goal
    State first;           // first base state on the goal's place; 0 if the place is not fixed
    std::uint32_t states;  // number of these base states; of all states if it is not fixed
    Time after_goal;
    TaskIndex work;  // the task that takes time at the next goal; -1: none
    Time latest;     // labels of greater f miss a deadline, or are above the cutoff
    // A label of f >= gate_from is postponed to layer gate_until; if this is kNever, it is dropped.
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
