// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace grove::detail {

// Throws std::invalid_argument(what) unless `holds`. Validates records from files and other
// processes.
inline void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace grove::detail
