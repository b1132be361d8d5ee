// SPDX-License-Identifier: MIT
// Every sequence, one by one: what the back ends are measured against.
#pragma once

#include "sequencing/rtsp.h"

namespace grove::detail::testing {

// The finite costs of all members of a class, cheapest first. Shares no text with the back ends.
std::vector<Time> all_costs(const CostMatrix& matrix, const SequenceClass& work);

// Does it visit each stop once?
bool is_complete(const CostMatrix& matrix, const Sequence& sequence);
// Is it a member of the class?
bool belongs(const Sequence& sequence, const SequenceClass& work);

}  // namespace grove::detail::testing
