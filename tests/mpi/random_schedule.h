// SPDX-License-Identifier: MIT
// Runs a distributed search in a single thread, with its events in random order.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/instance.h"

namespace grove::detail::testing {

struct Schedule {
  int ranks = 2;
  int workers = 1;  // per rank
  std::uint64_t seed = 0;
  std::int64_t max_steps = 60'000;
  std::int64_t max_turns = 5'000;  // limit on worker steps; a work item takes three
  int limit_rate = 0;  // probability per step, in 1/100,000, that a rank reaches a limit
};

struct ScheduleCounts {
  std::int64_t steps = 0;
  std::int64_t messages = 0;
  bool ended = false;          // false: killed, stuck, or max_steps or max_turns reached
  bool limit_reached = false;  // some rank reached a limit
  bool stuck = false;  // no message is in transit, no rank is active, and the run has not ended
  bool left_messages = false;  // a message is undelivered although all ranks have left
};

// Solves `instance`. In each step a worker performs a part of a work item or a rank polls for
// messages, and time advances. Messages have random delays. In the first quarter of `max_steps`,
// ranks are unresponsive for long periods, sometimes just after they have received a message. After
// every step of a rank `look` is called with the lower bound; if it returns true, all ranks are
// killed. Rethrows exceptions from the search.
Solution solve_in_random_order(const Instance& instance, const SolveOptions& options,
                               const Schedule& schedule, RunObserver& observer,
                               const std::function<bool(Cost)>& look, ScheduleCounts& counts);

}  // namespace grove::detail::testing
