// SPDX-License-Identifier: MIT
// Statistics of a run at one time: counts, and memory by kind.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Approximate memory of a process, in bytes.
struct MemoryUse {
  std::int64_t process = 0;    // resident set
  std::int64_t nodes = 0;      // constraint-tree nodes
  std::int64_t prices = 0;     // cached subproblem costs of agents
  std::int64_t path_sets = 0;  // cached MDDs
  std::int64_t groups = 0;     // cached dependencies of agents
};

// Counts of a process, by their names in plan files, and the memory that it uses.
struct ProcessStatistics {
  std::map<std::string, std::int64_t> counts;
  MemoryUse memory;
};

// Statistics of a rank.
struct RankStatistics {
  std::int64_t expanded = 0;
  std::int64_t open = 0;
  std::optional<Cost> bound;  // nullopt: no node is live on the rank
  std::int64_t memory = 0;    // resident memory of the process, in bytes
  std::int64_t low_level_calls = 0;
  std::int64_t branching_cost_queries = 0;
};

struct RunStatistics {
  ProcessStatistics whole;              // sum over all ranks
  std::map<int, RankStatistics> ranks;  // by rank: ranks that have reported so far
  int rank_count = 0;                   // 0: not a distributed run
};

// Adds the counts and bytes of `part` to `sum`.
inline void add(const ProcessStatistics& part, ProcessStatistics& sum) {
  for (const auto& [name, count] : part.counts) sum.counts[name] += count;
  sum.memory.process += part.memory.process;
  sum.memory.nodes += part.memory.nodes;
  sum.memory.prices += part.memory.prices;
  sum.memory.path_sets += part.memory.path_sets;
  sum.memory.groups += part.memory.groups;
}

// Adds the counts and bytes of `part` to `sum`, and copies the entries of `part.ranks` to it.
inline void add(const RunStatistics& part, RunStatistics& sum) {
  add(part.whole, sum.whole);
  for (const auto& [rank, statistics] : part.ranks) sum.ranks[rank] = statistics;
}

}  // namespace grove::detail
