// SPDX-License-Identifier: MIT
// The resources of the machine that this process may use.
#pragma once

#include <cstdint>

namespace grove::detail {

// The memory of the machine, in bytes.
std::uint64_t physical_memory();
// The memory of the machine in bytes, or less if a container or a batch system grants less.
std::uint64_t usable_memory();
// The number of cores that this process may use, >= 1.
int usable_cores();

}  // namespace grove::detail
