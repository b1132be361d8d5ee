// SPDX-License-Identifier: MIT
// JSON log of a run, as written by `grove solve --log FILE --log-format jsonl`.
#pragma once

#include <filesystem>
#include <string>

namespace grove::detail {

// Returns its complete lines, each an object with an `event`, the header first. Drops an incomplete
// last line, because the run may be in progress or killed. Throws InputError.
std::string read_run_log(const std::filesystem::path& path);

}  // namespace grove::detail
