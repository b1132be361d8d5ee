// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// Returns a YAML scalar that every parser reads as the string `text`. It is plain if `text` begins
// with a letter, consists of letters, digits, - and _, and has no special meaning in YAML;
// otherwise it is quoted. The result is ASCII.
std::string yaml_text(const std::string& text);

}  // namespace grove::detail
