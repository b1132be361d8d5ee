// SPDX-License-Identifier: MIT
// The choices that are left to an agent in a bound on routes.
#pragma once

#include <vector>

#include "model/instance.h"

namespace grove::detail {

struct RouteChoices {
  std::vector<TaskIndex> visits;  // of Agent::options: those that it may visit, in ascending order
  std::vector<TaskIndex> required;  // those of `visits` that it must visit, in ascending order
  std::vector<Place> goals;         // of Agent::goals
};

}  // namespace grove::detail
