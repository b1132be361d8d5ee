// SPDX-License-Identifier: MIT
// Converts constraints on the order of an agent's stops to a sequence class.
#pragma once

#include <span>

#include "planning/constraint.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The sequences of `work` that obey those of `constraints` that are about the sequence. The
// constraints may come in any order. Stops that follow from them are appended to the prefix. Throws
// std::invalid_argument if they define no class: the stop at each number must be determined by
// kStopIs before a constraint may concern the next number, and a constraint must name a stop that
// is left and was not ruled out.
SequenceClass narrowed(SequenceClass work, const AgentStops& stops,
                       std::span<const Constraint> constraints);

}  // namespace grove::detail
