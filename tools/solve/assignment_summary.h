// SPDX-License-Identifier: MIT
// Who does what, as text, for the end of the log.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// Returns lines with the tasks of each agent in the order of completion, and its last place; none
// if the instance has no choices. Long lists are cut, because the plan file has them in full.
std::vector<std::string> assignment_summary(const Instance& instance, const Plan& plan);

}  // namespace grove::detail
