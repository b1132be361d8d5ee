// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace grove::detail {

// What a record from elsewhere must be to be believed.
inline void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace grove::detail
