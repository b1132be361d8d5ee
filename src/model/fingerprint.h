// SPDX-License-Identifier: MIT
// Fingerprint of an instance: a 64-bit hash.
#pragma once

#include <cstdint>

#include "model/instance.h"

namespace grove::detail {

// The same on every machine and in every version for instances that are the same to the search:
// map, starts, destinations, tasks and their order. Names and files do not count. Two other
// instances have the same fingerprint with a probability of 2^-64 only. The hash is FNV-1a, which
// does not resist deliberate collisions.
std::uint64_t fingerprint(const Instance& instance);

}  // namespace grove::detail
