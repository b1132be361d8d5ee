// SPDX-License-Identifier: MIT
// Dominance between labels at stops (*gates*).
//
// *Rule.* Let G be a label that was expanded on stop u, which it has just counted at time g, in an
// interval [.., b] of the place of u and from stage s. Let L be another label of s, at time t. A
// path P through L counts some stop next. If this stop is u and is counted at a time in [g, b], the
// agent of G can wait there until then, is in the same stage, and can continue like P. L cannot
// count u before t + dist(L, u). If that is g or later, L is needed for u only in a later interval.
// If the next interval begins at n, such paths cost n + onward(u) or more. For an onward stop u
// without such a G the bound is t + dist(L, u) + onward(u). L is postponed to the least of these
// bounds over all onward stops, and dropped if there is no bound. (Paths through onward stops that
// the graph does not cover cost outside_bound() or more. If a label with such a stop is postponed
// or dropped, it counts as dropped because of its stage.)
//
// *Soundness* is that of the gates in fixed_order_goals.h: if L is postponed beyond the optimal
// cost, an optimal path can be replaced by one through a G with fewer stops left, so only finitely
// many replacements follow. With a fixed sequence a gate holds for all earlier stages. Here it
// holds for one stage, because labels of earlier stages can count other stops on the way to u.
// Earlier stages have gates of their own.
//
// *Turning agents.* If agents turn, L can count u in a different state from G. The agent of G can
// then turn, too, on its place and within its interval, for a bounded number of steps. So the gate
// of a port dominates labels that count u by this port at least this number of steps after g.
// (After a task execution on u, G has all moves of the state in which it executed the task.)
//
// *Later interval* refers to the time of arrival. If agents may not rest on u by r and G arrived by
// r, there are two cases: if P arrives by r, it leaves u again, as G can; otherwise it arrives at n
// = r + 1 or later.
//
// *Copies.* G must have all continuations of P. If u is in a corridor with copies, a G in a copy in
// which a traversal is barred makes no gate. A G in the free copy makes one, because it has all
// continuations of agents in the other copies.
#include "planning/stop_dominance.h"

#include <algorithm>
#include <cstddef>

#include "model/assert.h"

namespace grove::detail {

void StopDominance::begin_search() {
  for (const StageId stage : stages_) by_stage_[stage] = kNone;
  stages_.clear();
  gates_.clear();
}

// Stores one gate per onward port: the one that postpones labels to the latest time.
void StopDominance::close(const SequenceStages& goals, StageId from, State state, Time time,
                          Time until) {
  const AgentStops& stops = goals.stops();
  const int stop = stops.stop_at(state);
  GROVE_ASSERT(stop >= 0 && (goals.stage(from).left >> stop & 1) != 0,
               "a gate is on a stop that was left before");
  const auto ways = goals.onward(goals.stage(from));
  const auto of_stop = [&](const SequenceStages::Onward& way) {
    return way.port / stops.ports() == stop;
  };
  if (std::ranges::none_of(ways, of_stop)) return;
  if (static_cast<std::size_t>(from) >= by_stage_.size())
    by_stage_.resize(2 * static_cast<std::size_t>(from) + 1, kNone);
  if (by_stage_[from] == kNone) {
    stages_.push_back(from);
    gates_.resize(gates_.size() + ways.size());
    by_stage_[from] = static_cast<std::int32_t>(gates_.size() - ways.size());
  }
  for (std::size_t way = 0; way < ways.size(); ++way) {
    if (!of_stop(ways[way])) continue;
    Gate& gate = gates_[static_cast<std::size_t>(by_stage_[from]) + way];
    const Time there = time + stops.turn(state, ways[way].port);
    if (until > gate.until || (until == gate.until && there < gate.from)) gate = {there, until};
  }
}

Time StopDominance::min_cost(const SequenceStages& goals, StageId stage, State state,
                             Time time) const {
  GROVE_ASSERT(any(stage), "the stage has a gate");
  const Gate* gate = &gates_[static_cast<std::size_t>(by_stage_[stage])];
  Time least = kNever;
  for (const SequenceStages::Onward& way : goals.onward(goals.stage(stage))) {
    const Time there = time + goals.stops().to_port(state, way.port);
    const Time visit = there >= gate->from ? std::max(there, gate->until) : there;
    if (visit < kNever) least = std::min(least, visit + way.cost);
    ++gate;
  }
  return least;
}

}  // namespace grove::detail
