// SPDX-License-Identifier: MIT
// A number that tells instances apart.
#pragma once

#include <cstdint>

#include "model/instance.h"

namespace grove::detail {

// The same on every machine and in every version for instances that are the same to the search:
// grid, starts, destinations, tasks and their order; names and files do not count. Of two other
// instances the same only by a chance of 2^-64 (FNV-1a; not for those who forge instances).
std::uint64_t fingerprint(const Instance& instance);

}  // namespace grove::detail
