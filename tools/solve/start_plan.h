// SPDX-License-Identifier: MIT
// Plan files of earlier runs, as start plans and as existing output files.
#pragma once

#include <filesystem>

#include "model/plan.h"

namespace grove::detail {

// Reads the plan in the file, which must be valid for `instance`; other claims of the file (status,
// bound) are ignored. Throws InputError if it is not valid.
Plan read_valid_plan(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
