// SPDX-License-Identifier: MIT
// Reads files with new tasks for a plan in execution.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "execution/change.h"

namespace grove::detail {

struct ReadTask {
  NewTask task;
  std::string place;  // JSON Pointer, such as "/tasks/2"; "" if the file is a single task
};

// Reads {"tasks": [...]}, where each task has the keys of a task of an instance file, or a single
// task such as {"id": "t9", "cell": [3, 4], "agents": ["a0"]}. Throws InputError for invalid files,
// for unknown keys, for a cell that is not on the map of `instance`, and for an invalid duration.
// apply() checks the rest of a task (execution/change.h). `hints`: receives hints_on_need().
std::vector<ReadTask> read_new_tasks(const std::filesystem::path& path, const Instance& instance,
                                     std::vector<std::string>* hints = nullptr);

}  // namespace grove::detail
