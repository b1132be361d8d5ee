// SPDX-License-Identifier: MIT
#pragma once

#include "batch/progress.h"

namespace grove::detail {

// Returns the style for progress output on standard error, with the current width of the terminal.
batch::ProgressStyle stderr_style();

}  // namespace grove::detail
