// SPDX-License-Identifier: MIT
// Messages on standard error. It may be closed, a full disk or a pipe without a reader; then the
// message is lost, since there is no other place for it.
#pragma once

#include <string_view>

namespace grove::detail {

// Writes a line to standard error if possible. Throws nothing. Thread-safe.
void print_to_stderr(std::string_view line);

}  // namespace grove::detail
