// SPDX-License-Identifier: MIT
// Fingerprint of an instance: a 64-bit hash of everything that the search depends on.
#pragma once

#include <cstdint>

#include "model/instance.h"

namespace grove::detail {

// The fingerprint covers the map, the starts, motions and destinations of the agents, the tasks,
// the order of agents and of tasks, and whether following is allowed. It does not cover ids,
// coordinates or file names. It is the same on every machine and in every version. Different
// instances have equal fingerprints with a probability of about 2^-64. The hash is FNV-1a, which
// does not resist deliberate collisions.
std::uint64_t fingerprint(const Instance& instance);

}  // namespace grove::detail
