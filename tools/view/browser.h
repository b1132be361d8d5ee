// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// Opens a file or an address with the desktop's opener (xdg-open) and does not wait for it. Throws
// InputError if there is none.
void open_in_browser(std::string target);

}  // namespace grove::detail
