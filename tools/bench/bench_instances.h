// SPDX-License-Identifier: MIT
// The instances of a benchmark in their solving order.
#pragma once

#include <string>
#include <vector>

#include "batch/instance_facts.h"

namespace grove::detail::bench {

struct BenchInstance {
  batch::Entry entry;
  batch::InstanceMetadata facts;
  std::string kind = {};   // features that determine whether a method supports the instance
  std::string error = {};  // why the instance cannot be read; "" if it can
};

// Reads each of `entries` once. An entry that cannot be read gets an error and no facts. Returns
// the instances sorted by scenario number (0 if an entry has none), otherwise in their original
// order. Therefore all combinations of map, number of agents and number of tasks are solved for one
// scenario before any is solved for the next, and a partial table of results is balanced.
std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries);

}  // namespace grove::detail::bench
