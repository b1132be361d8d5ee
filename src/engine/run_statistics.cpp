// SPDX-License-Identifier: MIT
#include "engine/run_statistics.h"

namespace grove::detail {

void add(const ProcessStatistics& part, ProcessStatistics& sum) {
  for (const auto& [name, count] : part.counts) sum.counts[name] += count;
  sum.memory.process += part.memory.process;
  sum.memory.nodes += part.memory.nodes;
  sum.memory.prices += part.memory.prices;
  sum.memory.path_sets += part.memory.path_sets;
  sum.memory.groups += part.memory.groups;
}

void add(const RunStatistics& part, RunStatistics& sum) {
  add(part.whole, sum.whole);
  for (const auto& [rank, survey] : part.ranks) sum.ranks[rank] = survey;
}

}  // namespace grove::detail
