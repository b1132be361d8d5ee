// SPDX-License-Identifier: MIT
// Presolve: detects many of the instances that have no plan, on which CBS does not terminate.
#pragma once

#include <optional>
#include <string>

#include "planning/problem.h"

namespace grove::detail {

// Returns a sentence that tells the user why the instance has no plan; nullopt if presolve does not
// prove that. Detects required cells that an agent cannot reach from its start, or not one after
// the other; agents that cannot all rest on different cells; and agents that would have to pass
// each other in a corridor, or in another part of the map with too few free places.
std::optional<std::string> presolve_infeasibility(const Problem& problem);

}  // namespace grove::detail
