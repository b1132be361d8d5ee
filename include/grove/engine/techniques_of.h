// SPDX-License-Identifier: MIT
// The techniques of a run.
#pragma once

#include "grove/engine/solve.h"

namespace grove {

// The paper's policy is the cross-check: plain CBS.
inline Techniques techniques_of(const SolveOptions& options) {
  return options.policy == Policy::kFixed ? Techniques() : options.techniques;
}

}  // namespace grove
