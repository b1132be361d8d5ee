// SPDX-License-Identifier: MIT
// Messages on standard error. If it cannot be written (closed, disk full, pipe without a reader),
// the message is lost, because there is no other place to report it.
#pragma once

#include <string_view>

namespace grove::detail {

// Writes a line to standard error if possible. Never throws. Thread-safe.
void print_to_stderr(std::string_view line);

}  // namespace grove::detail
