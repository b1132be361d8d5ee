// SPDX-License-Identifier: MIT
// Processor time of a thread.
#pragma once

namespace grove::detail {

// Processor time of the calling thread, in seconds.
double processor_time();

}  // namespace grove::detail
