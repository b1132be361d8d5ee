// SPDX-License-Identifier: MIT
// Enumeration of all sequences, the reference for the rTSP back ends.
#pragma once

#include "sequencing/rtsp.h"

namespace grove::detail::testing {

// The finite costs of all members of a class, in ascending order. Shares no code with the back
// ends.
std::vector<Time> all_costs(const CostMatrix& matrix, const SequenceClass& work);

// Does `sequence` visit each stop exactly once?
bool is_complete(const CostMatrix& matrix, const Sequence& sequence);
// Is `sequence` a member of the class?
bool belongs(const Sequence& sequence, const SequenceClass& work);

}  // namespace grove::detail::testing
