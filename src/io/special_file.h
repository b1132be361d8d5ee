// SPDX-License-Identifier: MIT
// Devices, pipes and the like, which are written to as they stand.
#pragma once

#include <filesystem>

namespace grove::detail {

// Is it a file that write_file_atomically() writes to directly? /dev/stdout is one, even where it
// is a regular file, which others have open.
bool is_special_file(const std::filesystem::path& path);
bool is_special_file(const std::filesystem::path& path, const std::filesystem::file_status& status);

}  // namespace grove::detail
