// SPDX-License-Identifier: MIT
// A plan file as the first incumbent of a run.
#pragma once

#include <filesystem>

#include "grove/model/plan.h"

namespace grove {

// The plan in the file, which must be valid for `instance`; what else the file claims (status,
// bound) does not count. Prints warnings on stderr. Throws InputError that tells what is wrong.
Plan read_start_plan(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove
