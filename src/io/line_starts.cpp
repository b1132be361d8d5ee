// SPDX-License-Identifier: MIT
#include "io/line_starts.h"

#include <algorithm>

#include "io/text_file.h"

namespace grove::detail {

LineStarts::LineStarts(std::string_view text) : starts_{0} {
  for (std::size_t end = text.find('\n'); end != std::string_view::npos;
       end = text.find('\n', end + 1))
    starts_.push_back(end + 1);
}

std::string LineStarts::place(std::size_t offset) const {
  const auto line = std::ranges::upper_bound(starts_, offset) - starts_.begin();
  return line_and_column(static_cast<std::size_t>(line), offset - starts_[line - 1] + 1);
}

}  // namespace grove::detail
