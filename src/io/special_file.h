// SPDX-License-Identifier: MIT
// Devices, pipes and other special files, which are written to directly.
#pragma once

#include <filesystem>

namespace grove::detail {

// True if write_file_atomically() writes directly to this file. This includes /dev/stdout, even if
// it is a regular file, because other processes have it open.
bool is_special_file(const std::filesystem::path& path);
bool is_special_file(const std::filesystem::path& path, const std::filesystem::file_status& status);

}  // namespace grove::detail
