// SPDX-License-Identifier: MIT
// A* for the earliest arrivals at pairs (safe interval, has the agent visited the stop?). An agent
// that arrives earlier in an interval can wait and then continue like one that arrives later.
// Therefore a pair that the search does not reach is unreachable, and no pair is reachable earlier
// than the search reaches it. Pairs are ordered by time plus a lower bound on the time to go, which
// is a distance without intervals and hence consistent.
#include "planning/single_stop_bound.h"

#include <algorithm>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

Time SingleStopBound::min_cost(const AgentStops& stops, Time known_bound, const Limits& limits) {
  stops_ = &stops;
  bound_ = known_bound;
  for (int stop = 0; stop < stops.count() && !limits.stop_requested(); ++stop) {
    const Time bound = min_cost_through(stop);
    GROVE_ASSERT(bound >= bound_, "a further stop never lowers the bound");
    bound_ = bound;
  }
  return bound_;
}

// Returns the first time at which the agent can rest forever after visiting the stop `via`, at
// least bound_; kNever if that is impossible.
Time SingleStopBound::min_cost_through(int via) {
  via_ = via;
  after_via_ = 0;
  if (!stops_->rests_on_last_stop()) {
    const CostMatrix& matrix = stops_->cost_to_go().matrix();
    after_via_ = kNever;
    for (int port = via * matrix.ports; port < (via + 1) * matrix.ports; ++port)
      after_via_ = std::min(after_via_, matrix.to_end(port));
    if (after_via_ >= kNever) return kNever;
  }
  earliest_.assign(2 * static_cast<std::size_t>(intervals_.slot_limit()), kNever);
  queue_.reset(bound_);
  const State start = stops_->start();
  intervals_.ensure_intervals(world_.place(start));
  if (const int slot = intervals_.start_slot(start); slot >= 0) reach(slot, start, 0, false);
  Queue::Entry entry;
  while (queue_.pop(entry)) {
    if (earliest_[index(entry.slot, entry.progress)] < entry.time) continue;
    const bool visited = entry.progress != 0;
    if (visited && may_rest(entry.slot)) return std::max(bound_, entry.time);
    intervals_.for_each_move(entry.slot, entry.time, [&](int slot, State state, Time time) {
      reach(slot, state, time, visited);
    });
  }
  return kNever;
}

// Lower bound on the steps to a state of rest, through via_ unless it was visited; kNever if it is
// unreachable.
Time SingleStopBound::to_go(State state, bool visited) const {
  if (!visited) return std::min(kNever, stops_->distance(state, via_) + after_via_);
  return stops_->rests_on_last_stop() ? 0 : stops_->to_rest(state);
}

bool SingleStopBound::may_rest(int slot) const {
  if (!intervals_.may_rest(slot)) return false;
  const State state = intervals_.state_of(slot);
  return stops_->rests_on_last_stop() ? stops_->stop_at(state) >= 0 : stops_->to_rest(state) == 0;
}

void SingleStopBound::reach(int slot, State state, Time time, bool visited) {
  const int at = stops_->stop_at(state);
  if (at < AgentStops::kNoStop && AgentStops::stop_of_work(at) < 0) return;  // not its stop
  visited = visited || at == via_;
  Time& earliest = earliest_[index(slot, visited)];
  if (earliest <= time) return;
  earliest = time;
  const Time to_go = this->to_go(state, visited);
  if (to_go >= kNever) return;
  queue_.push(std::max(bound_, time + to_go),
              {.slot = slot,
               .time = time,
               .conflicts = static_cast<std::uint16_t>(std::min<Time>(to_go, Queue::kMaxConflicts)),
               .progress = static_cast<std::uint8_t>(visited)});
}

}  // namespace grove::detail
