// SPDX-License-Identifier: MIT
// The log of a run as a file: what `grove solve --log FILE --log-format jsonl` writes.
#pragma once

#include <filesystem>
#include <string>

namespace grove::detail {

// Its whole lines, each an object with an `event`, the header first. A last line that has not ended
// is left out: the run is still under way, or was killed. Throws InputError.
std::string read_run_log(const std::filesystem::path& path);

}  // namespace grove::detail
