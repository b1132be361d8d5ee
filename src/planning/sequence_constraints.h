// SPDX-License-Identifier: MIT
// Constraints on the order of an agent's stops, and the sequence class that they make.
#pragma once

#include <span>

#include "planning/constraint.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The sequences of `work` that obey those of `constraints` that are about the sequence, in any
// order, with stops that follow from them settled. Throws std::invalid_argument if they make no
// class: each stop number must be settled by kStopIs before anything is said of the next, of a stop
// that is left and was not ruled out.
SequenceClass narrowed(SequenceClass work, const AgentStops& stops,
                       std::span<const Constraint> constraints);

}  // namespace grove::detail
