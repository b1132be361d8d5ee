// SPDX-License-Identifier: MIT
// Reads the lines of a compressed certificate file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grove::detail::fuzz {

// Returns the lines of `file` without line ends; no lines if the file cannot be read. Throws
// std::runtime_error if it is not valid zstd data; truncation is not detected.
std::vector<std::string> certificate_lines(const std::filesystem::path& file);

}  // namespace grove::detail::fuzz
