// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// Where the lines of a text begin: for who asks for many places in it, as line_and_column_at()
// counts from the beginning each time.
class LineStarts {
 public:
  explicit LineStarts(std::string_view text);
  // "line 7, column 12" of the character at `offset`.
  std::string place(std::size_t offset) const;

 private:
  std::vector<std::size_t> starts_;
};

}  // namespace grove::detail
