// SPDX-License-Identifier: MIT
// The page's style and program, as CMake has bundled them into this one.
#pragma once

#include <string_view>

namespace grove {

std::string_view page_style();
std::string_view page_program();

}  // namespace grove
