// SPDX-License-Identifier: MIT
// Every way to split a node on a conflict.
#pragma once

#include <span>
#include <vector>

#include "conflicts/conflict.h"
#include "search/problem.h"
#include "search/techniques.h"

namespace grove::detail {

// Appends the splits that the conflict, which is one of `paths` (by AgentIndex), allows with these
// techniques: the plain one of CBS, then those that reason further, the best to take unseen first.
void splits_of(const Conflict& conflict, std::span<const Path> paths, const Problem& problem,
               Techniques techniques, std::vector<Split>& splits);

}  // namespace grove::detail
