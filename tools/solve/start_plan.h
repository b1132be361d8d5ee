// SPDX-License-Identifier: MIT
// Reads plan files of earlier runs: start plans, and output files that already exist.
#pragma once

#include <filesystem>

#include "model/plan.h"

namespace grove::detail {

// Reads the plan in the file. Ignores the other claims of the file (status, bound). Throws
// InputError if the file cannot be read or has no plan that is valid for `instance`.
Plan read_valid_plan(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
