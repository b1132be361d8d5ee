// SPDX-License-Identifier: MIT
// The clock of one thread.
#pragma once

namespace grove::detail {

// Seconds that the calling thread has had a processor.
double processor_time();

}  // namespace grove::detail
