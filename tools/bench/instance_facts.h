// SPDX-License-Identifier: MIT
// What is benched: an instance, and what its rows say of it.
#pragma once

#include <vector>

#include "grove/batch/entry.h"
#include "grove/io/instance_file.h"
#include "tools/bench/row.h"

namespace grove::bench {

// The instance that `entry` names. Throws InputError.
LoadedInstance load(const batch::Entry& entry);

// The scenario is the number in an id such as room_s3_n5_m20_mg, none in others. The tasks are that
// name's M where it has one: an MG-MAPF instance of the paper has M tasks and one more where a
// destination was. Else all tasks are counted.
InstanceFacts facts_of(const batch::Entry& entry, const LoadedInstance& loaded);

struct BenchInstance {
  batch::Entry entry;
  InstanceFacts facts;
};

// All of `entries`, each read once to see that it can be. In the order in which to solve them: the
// first scenario of each map, number of agents and number of tasks before any second, so that what
// is done at any moment is balanced; otherwise as they stand. Throws InputError.
std::vector<BenchInstance> balanced(const std::vector<batch::Entry>& entries);

}  // namespace grove::bench
