// SPDX-License-Identifier: MIT
// Instances that can be seen to have no plan. CBS alone does not end on those.
#pragma once

#include <optional>
#include <string>

#include "search/problem.h"

namespace grove::detail {

// Why the instance has no plan, as a sentence for a person; none if that cannot be seen here.
// Finds: cells that an agent must reach and cannot; agents that cannot all rest on different cells;
// agents that would have to pass each other in a corridor, or anywhere with too little room.
std::optional<std::string> presolve_infeasibility(const Problem& problem);

}  // namespace grove::detail
