// SPDX-License-Identifier: MIT
// A short order of visits without a proof.
#pragma once

#include "sequencing/sequence.h"

namespace grove::detail {

// A complete sequence that no move of at most three stops in a row and no reversal makes cheaper:
// cheapest insertion, then 2-opt and Or-opt (Or 1976). With ports, by the least legs. If some legs
// have no way, its cost may be kNever although another sequence has one. O(stops^3), and as
// much for each improvement of the local search.
Sequence good_sequence(const CostMatrix& matrix);

}  // namespace grove::detail
