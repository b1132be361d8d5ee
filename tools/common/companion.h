// SPDX-License-Identifier: MIT
// Programs that lie beside this one and do what few runs need: what they take to start costs no
// other command.
#pragma once

#include <string>
#include <vector>

namespace grove {

// Becomes that program; returns never. Throws InputError if it is not there or cannot be run.
[[noreturn]] void become(const std::string& companion, const std::vector<std::string>& arguments);

}  // namespace grove
