// SPDX-License-Identifier: MIT
// Programs beside this one with functions that few commands need, so that other commands start
// without their libraries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// Makes `text` the standard input of this program, and of a program that exec_program() starts.
// Throws InputError.
void replace_standard_input(std::string_view text);

// Returns the path of a program that is built and installed beside this one. Throws InputError if
// there is none.
std::string program_beside(const std::string& name);

// Replaces this process by that program (exec); does not return. Throws InputError if it does not
// exist or cannot be run. `package`: the Debian package that contains it.
[[noreturn]] void exec_program(const std::string& name, const std::vector<std::string>& arguments,
                               const std::string& package = "grove");

}  // namespace grove::detail
