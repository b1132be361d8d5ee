// SPDX-License-Identifier: MIT
// Splits by symmetry reasoning, one function per kind of conflict. The proof that no plan is lost
// is at the head of the named file.
#pragma once

#include <optional>
#include <span>

#include "conflicts/conflict.h"
#include "planning/corridors.h"

namespace grove::detail {

// Target reasoning, if one agent of the conflict has come to rest where the other passes: the split
// "it does not come to rest there by then | it does, and no other agent is there from then on". See
// target.cpp.
std::optional<Split> target_split(const Conflict& conflict, std::span<const Path> paths,
                                  const World& world, const Corridors& corridors);

// Corridor reasoning, if the two agents of the conflict meet while they traverse a corridor in
// opposite directions: the split "one agent does not leave it at its far end at these times | the
// other does not at its own". See corridor.cpp.
std::optional<Split> corridor_split(const Conflict& conflict, std::span<const Path> paths,
                                    const World& world, const Corridors& corridors);

}  // namespace grove::detail
