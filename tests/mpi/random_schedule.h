// SPDX-License-Identifier: MIT
// A distributed search inside one thread, in which whatever can happen next happens in random
// order.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/instance.h"

namespace grove::detail::testing {

struct Schedule {
  int ranks = 2;
  int workers = 1;  // of each rank
  std::uint64_t seed = 0;
  std::int64_t most_steps = 60'000;
  std::int64_t most_turns = 5'000;  // of workers, in three parts each
  int strikes = 0;                  // in a hundred thousand steps, of a limit on one rank
};

struct ScheduleCounts {
  std::int64_t steps = 0;
  std::int64_t messages = 0;
  bool ended = false;          // else it was killed, or most_steps were made
  bool struck = false;         // by a limit
  bool stuck = false;          // nothing is under way, nobody does anything, and it is not over
  bool left_messages = false;  // that nobody heard, though all have left
};

// Solves `instance`: each step is a part of a worker's turn, a look at the messages by one rank, or
// the passing of time; messages are late by random amounts, and ranks stand still for long, some
// of them just when they have heard something. After every step `look` is told the lower bound; if
// it says so, all are killed. Throws what the search throws.
Solution solve_in_random_order(const Instance& instance, const SolveOptions& options,
                               const Schedule& schedule, RunObserver& observer,
                               const std::function<bool(Cost)>& look, ScheduleCounts& counts);

}  // namespace grove::detail::testing
