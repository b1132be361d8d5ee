// SPDX-License-Identifier: MIT
// The last place to say something: it may be closed, a full disk or a pipe that nobody reads, and
// there is nothing more to do then.
#pragma once

#include <string_view>

namespace grove::detail {

// Writes a line to stderr, if that can be. Throws nothing. Of any thread.
void say_on_stderr(std::string_view line);

}  // namespace grove::detail
