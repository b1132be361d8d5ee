// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// `text` as a YAML scalar that every reader takes for this text: plain if it is a name that cannot
// be anything else, quoted otherwise. In ASCII.
std::string yaml_text(const std::string& text);

}  // namespace grove::detail
