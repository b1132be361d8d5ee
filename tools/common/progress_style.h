// SPDX-License-Identifier: MIT
#pragma once

#include "batch/progress.h"

namespace grove::detail {

// Progress on stderr, as wide as that is now.
batch::ProgressStyle stderr_style();

}  // namespace grove::detail
