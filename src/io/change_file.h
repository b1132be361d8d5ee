// SPDX-License-Identifier: MIT
// Reads files of new tasks for plans in execution.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "execution/change.h"

namespace grove::detail {

struct ReadTask {
  NewTask task;
  std::string place;  // position in the file: "/tasks/2", or "" for the only task of the file
};

// Reads {"tasks": [...]}, each task as in an instance, or a single task: {"id": "t9", "cell": [3,
// 4], "agents": ["a0"]}. Throws InputError for unknown keys, and for a task that is impossible in
// `instance` whatever its agents are.
std::vector<ReadTask> read_new_tasks(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
