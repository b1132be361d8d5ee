// SPDX-License-Identifier: MIT
// JSON log of a run, as written by `grove solve --log FILE --log-format jsonl`.
#pragma once

#include <filesystem>
#include <string>

namespace grove::detail {

// Returns the complete lines of the log, each an object with an `event`, the header first. Drops an
// incomplete last line, because the run may be in progress or was killed. Throws InputError if the
// file is invalid.
std::string read_run_log(const std::filesystem::path& path);

}  // namespace grove::detail
