// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grove::detail {

// Opens a file or an address with xdg-open, without waiting for it. Throws InputError if xdg-open
// cannot be run.
void open_in_browser(std::string target);

}  // namespace grove::detail
