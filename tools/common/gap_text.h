// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "model/omega.h"

namespace grove::detail {

// Returns (cost - lower_bound) / lower_bound in percent, such as "0.95 %". Returns "-" if `cost` is
// nullopt, and "infinite" if the bound is 0 and the cost is not.
std::string gap_text(std::optional<Cost> cost, Cost lower_bound);

}  // namespace grove::detail
