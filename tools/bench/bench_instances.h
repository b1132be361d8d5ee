// SPDX-License-Identifier: MIT
// What is benched, and in which order.
#pragma once

#include <string>
#include <vector>

#include "batch/instance_facts.h"

namespace grove::detail::bench {

struct BenchInstance {
  batch::Entry entry;
  batch::InstanceFacts facts;
  std::string kind = {};   // instances of one kind suit the same methods, as a rule
  std::string error = {};  // why it cannot be read; empty: it can
};

// All of `entries`, each read once: what cannot be read has an error, and no facts. In the order in
// which to solve them: the first scenario of each map, number of agents and number of tasks before
// any second, so that the results at any moment are balanced; otherwise as they stand.
std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries);

}  // namespace grove::detail::bench
