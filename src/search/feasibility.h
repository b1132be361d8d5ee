// SPDX-License-Identifier: MIT
// Presolve: detects instances without a plan. CBS does not terminate on these.
#pragma once

#include <optional>
#include <string>

#include "search/problem.h"

namespace grove::detail {

// Returns why the instance has no plan, as a sentence for the user; nullopt if presolve does not
// prove that. Detects: cells that an agent must reach and cannot; agents that cannot all rest on
// different cells; agents that would have to pass each other in a corridor, or in another part of
// the map with too few free places.
std::optional<std::string> presolve_infeasibility(const Problem& problem);

}  // namespace grove::detail
