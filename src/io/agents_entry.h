// SPDX-License-Identifier: MIT
// The key "agents" of a task: a list of ids, or "*".
#pragma once

#include "io/json_value.h"

namespace grove::detail {

// True if "agents" of `task` is "*", which stands for all agents. Throws InputError for any other
// string, and if there is no such key.
bool is_for_all_agents(const JsonValue& task);

}  // namespace grove::detail
