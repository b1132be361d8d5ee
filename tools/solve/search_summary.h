// SPDX-License-Identifier: MIT
// Statistics of a search for --verbose.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Returns lines for the end of a log; none if `stats` has no counts of the search.
std::vector<std::string> search_summary(const Stats& stats);

}  // namespace grove::detail
