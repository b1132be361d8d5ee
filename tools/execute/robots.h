// SPDX-License-Identifier: MIT
// Reads robots and plans that the command line names.
#pragma once

#include <string>

#include "io/plan_import.h"
#include "model/instance.h"

namespace grove::detail {

// Throws CLI::ValidationError with the message "OPTION: found 'TEXT'; expected EXPECTED".
[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected);

// Returns the robot `id`, where `id` is the first part of the value `text` of `option`. Throws
// CLI::ValidationError if there is no such robot.
AgentIndex robot_of(const std::string& option, const std::string& text, const std::string& id,
                    const Instance& instance);

// Reads the plan to execute, in any supported format. Throws InputError if the file contains no
// plan or the plan is not valid for `instance`.
ClaimedPlan read_plan_to_execute(const std::string& file, const Instance& instance);

}  // namespace grove::detail
