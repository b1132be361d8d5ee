// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// True if `text` is valid UTF-8, so that JSON files can contain it.
bool is_utf8(const std::string& text);

}  // namespace grove::detail
