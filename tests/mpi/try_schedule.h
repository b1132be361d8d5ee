// SPDX-License-Identifier: MIT
// Solves a random tiny instance with a random number of ranks and events in random order, and
// checks all claims against the optimum.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail::testing {

struct ScheduleTally {
  std::int64_t tried = 0;  // instances with a known optimum
  std::int64_t unfinished = 0;
  std::int64_t nodes = 0;
  std::int64_t messages = 0;
  std::int64_t batches = 0;
  std::int64_t restarts = 0;
  std::int64_t remote_pricings = 0;  // pricing problems that other ranks solved for rank 0
  std::int64_t learned_bounds = 0;   // learned bounds that ranks sent to each other
  std::int64_t resumed = 0;
  std::int64_t limit_reached = 0;
  std::int64_t reopened = 0;  // number of times that a single process resumed from a checkpoint
};

// Returns the errors: false claims, deadlocks, and lost messages or checkpoints. The same seed
// gives the same run.
std::vector<std::string> try_schedule(std::uint64_t seed, ScheduleTally& tally);

}  // namespace grove::detail::testing
