// SPDX-License-Identifier: MIT
// Reads files as text, and names positions in them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// The whole file without a UTF-8 byte order mark. Throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& path);

// The lines of `text`, without line ends (LF or CRLF) and without empty lines at the end.
std::vector<std::string_view> split_lines(std::string_view text);

// "line 7, column 12"; both numbers count from 1.
std::string line_and_column(std::size_t line, std::size_t column);
// The same for the character at `offset`.
std::string line_and_column_at(std::string_view text, std::size_t offset);

}  // namespace grove::detail
