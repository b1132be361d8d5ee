// SPDX-License-Identifier: MIT
// Reads files as text, names positions in them, and checks their encoding.
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

// The offsets of the lines of a text. For callers that need many positions; line_and_column_at()
// counts from the beginning in each call.
class LineStarts {
 public:
  explicit LineStarts(std::string_view text);
  // The position of the character at `offset`, such as "line 7, column 12".
  std::string place(std::size_t offset) const;

 private:
  std::vector<std::size_t> starts_;
};

// True if `text` is valid UTF-8, so that JSON files can contain it.
bool is_utf8(const std::string& text);

}  // namespace grove::detail
