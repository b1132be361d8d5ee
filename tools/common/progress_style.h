// SPDX-License-Identifier: MIT
#pragma once

#include "batch/progress.h"

namespace grove::detail {

// Returns the style of progress on standard error, with its current width.
batch::ProgressStyle stderr_style();

}  // namespace grove::detail
