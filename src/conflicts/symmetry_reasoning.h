// SPDX-License-Identifier: MIT
// Splits that say more than "not here, not now": one function for each kind of conflict that is
// reasoned about. The argument why no plan is lost is at the head of the file that is named.
#pragma once

#include <optional>
#include <span>

#include "conflicts/conflict.h"
#include "planning/corridors.h"

namespace grove::detail {

// If one agent of the conflict has come to rest where the other passes: the split "it does not come
// to rest there by then | it does, and nobody else is there from then on". target.cpp.
std::optional<Split> target_split(const Conflict& conflict, std::span<const Path> paths,
                                  const World& world, const Corridors& corridors);

// If the two agents of the conflict meet while they pass a chain in opposite directions: the split
// "the one does not leave it at its end at these times | the other does not at its own".
// traversal.cpp.
std::optional<Split> corridor_split(const Conflict& conflict, std::span<const Path> paths,
                                    const World& world, const Corridors& corridors);

}  // namespace grove::detail
