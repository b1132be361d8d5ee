// SPDX-License-Identifier: MIT
// Enumeration of all sequences, as the reference for the rTSP back ends.
#pragma once

#include "sequencing/rtsp.h"

namespace grove::detail::testing {

// Returns the finite costs of all sequences in a class, in ascending order. Shares no code with the
// back ends.
std::vector<Time> all_costs(const CostMatrix& matrix, const SequenceClass& work);

// Returns whether `sequence` visits each stop exactly once.
bool is_complete(const CostMatrix& matrix, const Sequence& sequence);
// Returns whether `sequence` is in the class.
bool belongs(const Sequence& sequence, const SequenceClass& work);

}  // namespace grove::detail::testing
