// SPDX-License-Identifier: MIT
// Programs that lie beside this one and do what few runs need: what they take to start costs no
// other command.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// What standard input then holds, in this program and in the one that it becomes. Throws
// InputError.
void replace_standard_input(std::string_view text);

// A program of users that is built and installed beside this one. Throws InputError if it is not.
std::string program_beside(const std::string& name);

// Becomes that program; does not return. Throws InputError if it is not there or cannot be run.
// `package`: the Debian package that holds it.
[[noreturn]] void exec_program(const std::string& name, const std::vector<std::string>& arguments,
                               const std::string& package = "grove");

}  // namespace grove::detail
