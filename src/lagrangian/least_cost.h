// SPDX-License-Identifier: MIT
// What an agent alone pays at least.
#pragma once

#include "model/limits.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Exact, unless limits strike: then a lower bound. Widens the completions so far that they hold an
// order that costs no more.
Time least_cost(SequenceStages& goals, const Limits& limits);

}  // namespace grove::detail
