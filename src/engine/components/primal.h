// SPDX-License-Identifier: MIT
// Share of the effort that the primal search asks for.
#pragma once

#include <cstdint>

#include "model/tuning.h"
#include "primal/primal_search.h"

namespace grove::detail {

// The formulas are at the head of the .cpp. `agents`: number of agents of the instance.
double wanted_primal_share(const PrimalSearch& primal, int agents, const Tuning& tuning);
// `tree_work`: effort of the tree search so far, in the unit of model/effort.h.
double max_primal_share(std::int64_t tree_work, bool gap_is_large, const Tuning& tuning);

}  // namespace grove::detail
