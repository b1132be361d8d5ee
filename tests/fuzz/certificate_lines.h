// SPDX-License-Identifier: MIT
// Reads the lines of a compressed certificate file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grove::detail::fuzz {

// Returns the lines of `file` without line ends. Throws std::runtime_error if it is not valid zstd
// data.
std::vector<std::string> certificate_lines(const std::filesystem::path& file);

}  // namespace grove::detail::fuzz
