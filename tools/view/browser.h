// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// Hands a file or an address to the desktop's own opener and does not wait for it. Throws
// InputError where there is none.
void open_in_browser(std::string target);

}  // namespace grove::detail
