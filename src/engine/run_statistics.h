// SPDX-License-Identifier: MIT
// What a run has done and what it holds at a moment, by kind.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Bytes that a process holds, about.
struct MemoryUse {
  std::int64_t process = 0;    // all of it, as the system counts
  std::int64_t nodes = 0;      // of constraint trees
  std::int64_t prices = 0;     // what agents cost in situations
  std::int64_t path_sets = 0;  // their sets of optimal paths
  std::int64_t groups = 0;     // what agents cost together
};

// What a process has done: counts by the names that they have in plan files.
struct ProcessStatistics {
  std::map<std::string, std::int64_t> counts;
  MemoryUse memory;
};

// What a rank does and holds.
struct RankStatistics {
  std::int64_t expanded = 0;
  std::int64_t open = 0;
  std::optional<Cost> bound;  // none where it holds no node
  std::int64_t memory = 0;    // bytes, of the process
  std::int64_t low_level_calls = 0;
  std::int64_t prices_asked = 0;
};

struct RunStatistics {
  ProcessStatistics whole;              // of all ranks together
  std::map<int, RankStatistics> ranks;  // those that have told something by now
  int rank_count = 0;                   // 0 where one process searches alone
};

// Adds counts to counts and bytes to bytes; takes over what is said of ranks.
void add(const RunStatistics& part, RunStatistics& sum);

// Adds counts to counts and bytes to bytes.
void add(const ProcessStatistics& part, ProcessStatistics& sum);

}  // namespace grove::detail
