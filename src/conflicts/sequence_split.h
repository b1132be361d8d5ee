// SPDX-License-Identifier: MIT
// Splitting a sequence class.
#pragma once

#include "conflicts/conflict.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The split "the agent's next stop is the one that `sequence` has there | it is another", where
// `work`, the class that the agent is in, leaves it open: `sequence` must be of that class, and
// longer than its prefix. The essay is at the head of sequence_split.cpp.
Split sequence_split(AgentIndex agent, const AgentStops& stops, const SequenceClass& work,
                     const Sequence& sequence);

// Does the class leave a choice of the next stop?
bool leaves_choice(const AgentStops& stops, const SequenceClass& work);

}  // namespace grove::detail
