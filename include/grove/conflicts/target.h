// SPDX-License-Identifier: MIT
// Target reasoning: splitting on when an agent comes to rest.
#pragma once

#include <optional>
#include <span>

#include "grove/conflicts/conflict.h"

namespace grove {

// If one agent of the conflict has come to rest where the other passes: the split "it does not come
// to rest there by then | it does, and nobody else is there from then on". The essay is at the head
// of target.cpp.
std::optional<Split> target_split(const Conflict& conflict, std::span<const Path> paths);

}  // namespace grove
