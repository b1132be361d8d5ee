// SPDX-License-Identifier: MIT
// Solves one random tiny instance with random ranks and events in random order, and checks all
// claims against the optimum.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail::testing {

struct ScheduleTally {
  std::int64_t tried = 0;  // instances whose optimum could be computed
  std::int64_t unfinished = 0;
  std::int64_t nodes = 0;
  std::int64_t messages = 0;
  std::int64_t batches = 0;
  std::int64_t restarts = 0;
  std::int64_t prices = 0;  // subproblems that other ranks priced for rank 0
  std::int64_t facts = 0;   // learned bounds that ranks sent to each other
  std::int64_t resumed = 0;
  std::int64_t limit_reached = 0;
  std::int64_t reopened = 0;  // checkpoints from which a single process resumed
};

// Returns the false claims; empty if there are none. The same seed gives the same run.
std::vector<std::string> try_schedule(std::uint64_t seed, ScheduleTally& tally);

}  // namespace grove::detail::testing
