// SPDX-License-Identifier: MIT
// Traversal mutexes: splitting on which of two agents passes a corridor.
#pragma once

#include <optional>
#include <span>

#include "grove/conflicts/conflict.h"
#include "grove/planning/chains.h"

namespace grove {

// If the two agents of the conflict meet while they pass a chain in opposite directions: the split
// "the one does not leave it at its end at these times | the other does not at its own". The essay
// is at the head of traversal.cpp.
std::optional<Split> traversal_split(const Conflict& conflict, std::span<const Path> paths,
                                     const Chains& chains);

}  // namespace grove
