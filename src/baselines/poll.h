// SPDX-License-Identifier: MIT
// How often the searches look at the limits.
#pragma once

#include <cstdint>

namespace grove {

// Some tenth of a millisecond.
inline constexpr std::int64_t kExpansionsPerPoll = 512;

}  // namespace grove
