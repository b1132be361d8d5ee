// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// `text` as a YAML scalar that every parser reads as this text: plain if it is a name that has no
// other meaning, quoted otherwise. ASCII only.
std::string yaml_text(const std::string& text);

}  // namespace grove::detail
