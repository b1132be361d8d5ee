// SPDX-License-Identifier: MIT
// Fault injection: allocations that fail on request, in programs that link failing_new.cpp.
#pragma once

namespace grove::detail::testing {

// Number of allocations of this thread before one throws std::bad_alloc; negative: none throws.
extern thread_local int allocations_until_failure;

}  // namespace grove::detail::testing
