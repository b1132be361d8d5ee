// SPDX-License-Identifier: MIT
// Allocations that fail when a test wants it. Programs that link failing_new.cpp have it.
#pragma once

namespace grove::detail::testing {

// This thread's allocations before one throws std::bad_alloc; negative: none does.
extern thread_local int allocations_until_failure;

}  // namespace grove::detail::testing
