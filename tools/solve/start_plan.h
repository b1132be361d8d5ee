// SPDX-License-Identifier: MIT
// Plan files of earlier runs: as the first incumbent of this one, and as what it may leave alone.
#pragma once

#include <filesystem>

#include "model/plan.h"

namespace grove::detail {

// The plan in the file, which must be valid for `instance`; what else the file claims (status,
// bound) does not count. Throws InputError that tells what is wrong.
Plan read_valid_plan(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
