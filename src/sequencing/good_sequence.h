// SPDX-License-Identifier: MIT
// Heuristic for a short sequence, without a proof.
#pragma once

#include "sequencing/sequence.h"

namespace grove::detail {

// Returns a complete sequence that no move of at most three consecutive stops and no reversal makes
// cheaper: cheapest insertion, then 2-opt and Or-opt (Or 1976). With ports it uses the least legs
// over the ports. If some legs have no path, its cost may be kNever although another sequence has a
// finite cost. O(stops^3) for the insertion, and as much for each improvement of the local search.
Sequence good_sequence(const CostMatrix& matrix);

}  // namespace grove::detail
