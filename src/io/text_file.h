// SPDX-License-Identifier: MIT
// Reads text files, converts offsets to positions for messages, and checks the encoding.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// Reads a whole file. Removes a UTF-8 byte order mark. Throws InputError if the file cannot be read
// or is larger than 1 GiB.
std::string read_text(const std::filesystem::path& path);

// The lines of `text`, without line ends (LF or CRLF) and without empty lines at the end. They
// refer to `text`.
std::vector<std::string_view> split_lines(std::string_view text);

// Returns text such as "line 7, column 12". `line` and `column` count from 1.
std::string line_and_column(std::size_t line, std::size_t column);
// Returns the position of the character at `offset` in `text`, in the form of line_and_column().
std::string line_and_column_at(std::string_view text, std::size_t offset);

// The offsets of the lines of a text, for callers that need many positions, because
// line_and_column_at() counts lines from the beginning of the text in each call.
class LineStarts {
 public:
  explicit LineStarts(std::string_view text);
  // The position of the character at `offset`, such as "line 7, column 12".
  std::string place(std::size_t offset) const;

 private:
  std::vector<std::size_t> starts_;
};

// True if `text` is valid UTF-8, which JSON files require.
bool is_utf8(const std::string& text);

}  // namespace grove::detail
