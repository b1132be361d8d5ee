// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// "grove 0.1.0 (git 0123456789ab)"; with "-dirty" after the hash of a tree with changes.
std::string version_text();

}  // namespace grove::detail
