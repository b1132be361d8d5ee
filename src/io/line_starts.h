// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

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

}  // namespace grove::detail
