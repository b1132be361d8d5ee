// SPDX-License-Identifier: MIT
// Splits from symmetry reasoning, one function per kind of conflict. The comment on each function
// names the file whose head proves that no plan is lost.
#pragma once

#include <optional>
#include <span>

#include "conflicts/conflict.h"
#include "planning/corridors.h"

namespace grove::detail {

// Target reasoning (target.cpp). If the conflict is a vertex conflict and one of its agents has
// come to rest there for good, returns the split "this agent does not come to rest there by that
// time | it does, and no other agent is there from then on"; otherwise nullopt.
std::optional<Split> target_split(const Conflict& conflict, std::span<const Path> paths,
                                  const World& world, const Corridors& corridors);

// Corridor reasoning (corridor.cpp). If the two agents of the conflict meet while they traverse a
// corridor in opposite directions, returns the split "one agent does not complete a traversal to
// its far end in a time range | the other agent does not complete one to the other end in another
// time range". Each may arrive there without a traversal. Returns nullopt otherwise, for a
// following conflict, and if the arrivals of the two traversals differ by more than the number of
// moves from end to end.
std::optional<Split> corridor_split(const Conflict& conflict, std::span<const Path> paths,
                                    const World& world, const Corridors& corridors);

}  // namespace grove::detail
