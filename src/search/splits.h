// SPDX-License-Identifier: MIT
// All splits of a node on a conflict.
#pragma once

#include <span>
#include <vector>

#include "conflicts/conflict.h"
#include "search/problem.h"
#include "search/techniques.h"

namespace grove::detail {

// Appends the splits that these techniques allow for a conflict of `paths` (by AgentIndex): the
// standard split of CBS, then those of symmetry reasoning, the one to prefer without evaluation
// first.
void splits_of(const Conflict& conflict, std::span<const Path> paths, const Problem& problem,
               Techniques techniques, std::vector<Split>& splits);

}  // namespace grove::detail
