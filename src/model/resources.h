// SPDX-License-Identifier: MIT
// What this process may use of the machine.
#pragma once

#include <cstdint>

namespace grove::detail {

// The memory of the machine, in bytes.
std::uint64_t physical_memory();
// In bytes: the machine's memory, or less where a container or a batch system grants no more.
std::uint64_t usable_memory();
// The cores that this process may use; at least 1.
int usable_cores();

}  // namespace grove::detail
