// SPDX-License-Identifier: MIT
// Splits of a sequence class.
#pragma once

#include "conflicts/conflict.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The split "the agent's next stop is the one that `sequence` has there | it is another". `work` is
// the agent's class and must leave the stop open: `sequence` must be in the class and longer than
// its prefix. The argument is at the head of sequence_split.cpp.
Split sequence_split(AgentIndex agent, const AgentStops& stops, const SequenceClass& work,
                     const Sequence& sequence);

// True if the class leaves a choice of the next stop.
bool leaves_choice(const AgentStops& stops, const SequenceClass& work);

}  // namespace grove::detail
