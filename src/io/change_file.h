// SPDX-License-Identifier: MIT
// New tasks as files, for plans that are being driven.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "execution/change.h"

namespace grove::detail {

struct ReadTask {
  NewTask task;
  std::string place;  // of it in the file: "/tasks/2", or "" for the file's only one
};

// {"tasks": [...]}, each as in an instance, or one alone: {"id": "t9", "cell": [3, 4], "agents":
// ["a0"]}. Throws InputError for unknown keys, and for what cannot be a task of `instance`, whoever
// its agents are.
std::vector<ReadTask> read_new_tasks(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
