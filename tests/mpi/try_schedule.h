// SPDX-License-Identifier: MIT
// One random tiny instance, solved by random ranks in random order, and held against the truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail::testing {

struct ScheduleTally {
  std::int64_t tried = 0;  // instances small enough for the truth
  std::int64_t unfinished = 0;
  std::int64_t nodes = 0;
  std::int64_t messages = 0;
  std::int64_t batches = 0;
  std::int64_t restarts = 0;
  std::int64_t prices = 0;  // that rank 0 asked others for, and counted
  std::int64_t facts = 0;   // that ranks told each other
  std::int64_t resumed = 0;
  std::int64_t struck = 0;
  std::int64_t reopened = 0;  // checkpoints from which one process went on
};

// What was false; empty: nothing. The same seed makes the same run.
std::vector<std::string> try_schedule(std::uint64_t seed, ScheduleTally& tally);

}  // namespace grove::detail::testing
