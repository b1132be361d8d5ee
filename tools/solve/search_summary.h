// SPDX-License-Identifier: MIT
// Statistics of a search as text, for --verbose.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Returns lines for the end of the text log; none if `stats` has no counts of a tree search.
std::vector<std::string> search_summary(const Stats& stats);

}  // namespace grove::detail
