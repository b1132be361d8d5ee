// SPDX-License-Identifier: MIT
#include "tools/common/standard_error.h"

#include <cstdio>

namespace grove::detail {

void print_to_stderr(std::string_view line) {
  std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
}

}  // namespace grove::detail
