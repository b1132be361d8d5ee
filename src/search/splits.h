// SPDX-License-Identifier: MIT
// Lists the splits that a conflict allows.
#pragma once

#include <span>
#include <vector>

#include "conflicts/conflict.h"
#include "planning/problem.h"
#include "search/techniques.h"

namespace grove::detail {

// Appends the splits that `techniques` allow for a conflict of `paths` (by AgentIndex): first the
// standard CBS split, then the splits from symmetry reasoning, the preferred one first.
void splits_of(const Conflict& conflict, std::span<const Path> paths, const Problem& problem,
               Techniques techniques, std::vector<Split>& splits);

}  // namespace grove::detail
