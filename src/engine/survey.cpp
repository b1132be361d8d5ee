// SPDX-License-Identifier: MIT
#include "grove/detail/engine/survey.h"

namespace grove::detail {

void add(const Account& part, Account& sum) {
  for (const auto& [name, count] : part.counts) sum.counts[name] += count;
  sum.memory.process += part.memory.process;
  sum.memory.nodes += part.memory.nodes;
  sum.memory.prices += part.memory.prices;
  sum.memory.path_sets += part.memory.path_sets;
  sum.memory.groups += part.memory.groups;
}

}  // namespace grove::detail
