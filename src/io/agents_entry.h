// SPDX-License-Identifier: MIT
// The keys "agents" of a task, a list of ids or "*", and "need".
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/json_value.h"

namespace grove::detail {

// True if "agents" of `task` is "*", which stands for all agents. Throws InputError for any other
// string, and if there is no such key.
bool is_for_all_agents(const JsonValue& task);

// Returns the ids of the agents of `task`. `all_ids` returns those of all agents of the instance.
// Throws InputError for a value that is neither "*" nor a list of ids, and for "*" in a list unless
// an agent has this id.
std::vector<std::string> agents_of_task(const JsonValue& task,
                                        const std::function<std::vector<std::string>()>& all_ids);

// Returns the need of `task`, from 1 to `agents`, the number of its agents; nullopt if it states
// none, or if it has no agents. Throws InputError for other values.
std::optional<int> need_of_task(const JsonValue& task, std::size_t agents);

// Returns a hint, one line, if "agents" is "*" in a task without "need". This is valid, but most
// users mean that any agent may visit the task. `tasks`: a list of tasks, or a single one.
// `agents`: the number of agents of the instance. `file`: the name of the file.
std::vector<std::string> hints_on_need(const JsonValue& tasks, std::size_t agents,
                                       const std::string& file);

}  // namespace grove::detail
