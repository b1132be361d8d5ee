// SPDX-License-Identifier: MIT
// The instances of a benchmark, read once, in the order in which they are solved.
#pragma once

#include <string>
#include <vector>

#include "batch/instance_facts.h"

namespace grove::detail::bench {

struct BenchInstance {
  batch::Entry entry;
  batch::InstanceMetadata facts;
  std::string kind = {};   // problem class; whether a method supports an instance depends on it
  std::string error = {};  // why the instance cannot be read; "" if it can
};

// Reads each of `entries` once. An entry that cannot be read has an error and no facts. Returns
// them in the order in which to solve them: the first scenario of each combination of map, number
// of agents and number of tasks comes before any second scenario, so that the results are balanced
// at any moment. Otherwise the order is kept.
std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries);

}  // namespace grove::detail::bench
