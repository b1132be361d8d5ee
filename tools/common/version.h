// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// Returns "grove 0.1.0 (git 0123456789ab)", with "-dirty" after the hash if the working tree had
// uncommitted changes.
std::string version_text();

}  // namespace grove::detail
