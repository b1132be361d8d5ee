// SPDX-License-Identifier: MIT
// What is benched, and in which order.
#pragma once

#include <vector>

#include "grove/detail/batch/instance_facts.h"

namespace grove::detail::bench {

struct BenchInstance {
  batch::Entry entry;
  batch::InstanceFacts facts;
};

// All of `entries`, each read once to see that it can be. In the order in which to solve them: the
// first scenario of each map, number of agents and number of tasks before any second, so that what
// is done at any moment is balanced; otherwise as they stand. Throws InputError.
std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries);

}  // namespace grove::detail::bench
