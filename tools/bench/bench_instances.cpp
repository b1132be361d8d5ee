// SPDX-License-Identifier: MIT
#include "tools/bench/bench_instances.h"

#include <algorithm>

namespace grove::detail::bench {

std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries) {
  std::vector<BenchInstance> instances;
  for (const batch::Entry& entry : entries)
    instances.push_back({entry, facts_of(entry, load(entry))});
  std::ranges::stable_sort(instances, {}, [](const BenchInstance& instance) {
    return instance.facts.scenario.value_or(0);
  });
  return instances;
}

}  // namespace grove::detail::bench
