// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// Whether JSON files can hold `text`.
bool is_utf8(const std::string& text);

}  // namespace grove::detail
