// SPDX-License-Identifier: MIT
// Selects the lemmas that a leaf needs among those that it could name.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "search/proof_log.h"

namespace grove::detail {

// Returns the excess that `excesses` imply together (search/covering.h). `steps` limits the effort.
// With 0 steps it only adds statements without a common agent.
inline constexpr std::int64_t kCoveringSteps = 100'000;
Cost covered(std::span<const ProofExcess> excesses, std::int64_t steps = kCoveringSteps);

// Removes excesses one after another, the last ones first, as long as the rest covers `wanted`.
void leave_out(std::vector<ProofExcess>& excesses, Cost wanted,
               std::int64_t steps = kCoveringSteps);

}  // namespace grove::detail
