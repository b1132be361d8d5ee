// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace grove::detail {

// Throws std::invalid_argument(what) if `holds` is false. Used to validate records from files and
// from other processes.
inline void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace grove::detail
