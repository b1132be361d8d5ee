// SPDX-License-Identifier: MIT
// Robots and plans named on the command line.
#pragma once

#include <string>

#include "io/plan_import.h"
#include "model/instance.h"

namespace grove::detail {

// Throws CLI::ValidationError: "`option`: found '`text`'; expected `expected`".
[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected);

// Returns the robot called `id`, the first part of `text`. Throws CLI::ValidationError.
AgentIndex robot_of(const std::string& option, const std::string& text, const std::string& id,
                    const Instance& instance);

// Reads the plan to execute, in any format, and prints warnings. Throws InputError if there is none
// or if it is not valid.
ClaimedPlan read_plan_to_execute(const std::string& file, const Instance& instance);

}  // namespace grove::detail
