// SPDX-License-Identifier: MIT
// What a search did, for who asks.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Lines for the end of a log; none about what `stats` do not know.
std::vector<std::string> search_summary(const Stats& stats);

}  // namespace grove::detail
