// SPDX-License-Identifier: MIT
#pragma once

#include "grove/batch/progress.h"

namespace grove {

// Progress on stderr, as wide as that is now.
batch::ProgressStyle stderr_style();

}  // namespace grove
