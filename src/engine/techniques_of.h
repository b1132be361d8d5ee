// SPDX-License-Identifier: MIT
// Search options that follow from the options of a run.
#pragma once

#include "engine/solve.h"

namespace grove::detail {

// The paper's policy kFixed is for cross-checks, and the published low levels are for comparison:
// both use plain CBS.
inline Techniques techniques_of(const SolveOptions& options) {
  const bool plain = options.policy == Policy::kFixed || options.low_level != LowLevel::kOwn;
  return plain ? Techniques() : options.techniques;
}

inline SearchOptions search_options_of(const SolveOptions& options) {
  return {techniques_of(options), options.seed,  options.audit,
          options.tuning,         options.proof, options.deterministic};
}

}  // namespace grove::detail
