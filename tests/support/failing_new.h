// SPDX-License-Identifier: MIT
// Fault injection: memory allocations that fail on request. For programs that link failing_new.cpp.
#pragma once

namespace grove::detail::testing {

// Number of allocations by this thread that still succeed before one fails. After the failure it is
// -1. Negative: no allocation fails. Over-aligned allocations are neither counted nor failed.
extern thread_local int allocations_until_failure;

}  // namespace grove::detail::testing
