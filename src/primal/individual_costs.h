// SPDX-License-Identifier: MIT
// Result of individual planning: costs of the agents' best paths without the other agents.
#pragma once

#include <cstdint>

#include "model/omega.h"

namespace grove::detail {

struct IndividualCosts {
  Cost sum = 0;  // over the agents planned so far
  bool are_minimal = true;
  std::int64_t work = 0;  // effort of individual planning: W in primal_search.cpp
};

}  // namespace grove::detail
