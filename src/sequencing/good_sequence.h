// SPDX-License-Identifier: MIT
// Heuristic for a sequence of low cost, without a bound.
#pragma once

#include "sequencing/sequence.h"

namespace grove::detail {

// Returns a complete sequence by cheapest insertion, followed by 2-opt and Or-opt (Or 1976):
// neither moving up to three consecutive stops nor reversing a part makes the sequence cheaper.
// With several ports per stop it uses the least legs over the ports. If some legs have no path, the
// cost can be kNever although another sequence has a finite cost. O(stops^3) for the insertion and
// for each improvement of the local search.
Sequence good_sequence(const CostMatrix& matrix);

}  // namespace grove::detail
