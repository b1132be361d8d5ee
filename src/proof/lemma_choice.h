// SPDX-License-Identifier: MIT
// Which of the lemmas that a leaf could name it needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "search/proof_log.h"

namespace grove::detail {

// What these say together (search/covering.h), and how hard to look for it: with 0 steps, what
// statements without a common agent add up to.
inline constexpr std::int64_t kCoveringSteps = 100'000;
Cost covered(std::span<const ProofExcess> excesses, std::int64_t steps = kCoveringSteps);

// Leaves out one after the other, the last ones first, for as long as the rest cover `wanted`.
void leave_out(std::vector<ProofExcess>& excesses, Cost wanted,
               std::int64_t steps = kCoveringSteps);

}  // namespace grove::detail
