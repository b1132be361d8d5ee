// SPDX-License-Identifier: MIT
// Robots and their plans, as one names them on the command line.
#pragma once

#include <string>

#include "io/plan_import.h"
#include "model/instance.h"

namespace grove::detail {

// Throws CLI::ValidationError: "`option`: found '`text`'; expected `expected`".
[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected);

// The robot called `id`, which begins `text`. Throws CLI::ValidationError.
AgentIndex robot_of(const std::string& option, const std::string& text, const std::string& id,
                    const Instance& instance);

// The plan of the instance that is to be driven, in any format; prints warnings. Throws InputError
// if there is none, or it is not valid.
ClaimedPlan read_plan_to_drive(const std::string& file, const Instance& instance);

}  // namespace grove::detail
