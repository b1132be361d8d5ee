// SPDX-License-Identifier: MIT
// A drive for its page: the log of it (docs/drive-log.md), and what the page has to know of the
// passing order.
#pragma once

#include <filesystem>
#include <string>

#include "grove/detail/execution/passing_order.h"
#include "grove/detail/model/instance.h"

namespace grove::detail {

// Its whole lines, the first one that of a drive of these robots; a last line that has not ended is
// left out. (The page reads the others strictly.) Throws InputError.
std::string read_drive_log(const std::filesystem::path& path, const Instance& instance);

// One JSON object (README.md beside this): of each robot when the plan has its actions end, which
// tasks they visit, and what they wait for.
std::string order_data(const Instance& instance, const PassingOrder& order);

}  // namespace grove::detail
