// SPDX-License-Identifier: MIT
// Earliest arrivals over (safe interval, been on the place), in order of time. The earliest arrival
// in an interval can do all that a later one can, after waiting; so what is not reached is not
// reachable, and what is reached is not reachable earlier.
#include "visit_check.h"

#include <algorithm>

namespace grove {

Time VisitCheck::least_cost(const AgentStops& stops, const Limits& limits) {
  rests_.clear();
  if (stops.destination()) rests_.push_back(*stops.destination());
  for (int stop = 0; stop < stops.count() && !stops.destination(); ++stop)
    rests_.push_back(stops.place(stop));
  Time least = 0;
  for (int stop = 0; stop < stops.count() && !limits.stop_requested(); ++stop)
    least = std::max(least, first_rest(stops.start(), stops.place(stop)));
  return least;
}

// The first time at which an agent that starts in `start` can rest for ever, having been on `via`;
// kNever: it cannot at all.
Time VisitCheck::first_rest(State start, Place via) {
  via_ = via;
  earliest_.assign(2 * static_cast<std::size_t>(intervals_.slot_limit()), kNever);
  queue_.reset(0);
  intervals_.see(world_.place(start));
  if (const int slot = intervals_.start_slot(start); slot >= 0) reach(slot, start, 0, false);
  Queue::Entry entry;
  while (queue_.pop(entry)) {
    const bool visited = entry.progress != 0;
    if (visited && intervals_.may_rest(entry.slot) &&
        std::ranges::count(rests_, intervals_.place_of(entry.slot)) > 0)
      return entry.time;
    intervals_.for_each_move(entry.slot, entry.time, [&](int slot, State state, Time time) {
      reach(slot, state, time, visited);
    });
  }
  return kNever;
}

void VisitCheck::reach(int slot, State state, Time time, bool visited) {
  visited = visited || world_.place(state) == via_;
  Time& earliest =
      earliest_[2 * static_cast<std::size_t>(slot) + static_cast<std::size_t>(visited)];
  if (earliest <= time) return;
  earliest = time;
  queue_.push(time, {.slot = slot, .time = time, .progress = static_cast<std::uint8_t>(visited)});
}

}  // namespace grove
