// SPDX-License-Identifier: MIT
// Helper programs that implement some commands. They are separate, so that grove itself starts
// without loading their libraries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// Makes `text` the standard input of this process, and therefore of a program that exec_program()
// starts. Throws InputError if a temporary file cannot be written.
void replace_standard_input(std::string_view text);

// Returns the path of the program `name` in the folder of this program. Throws InputError if it
// does not exist.
std::string program_beside(const std::string& name);

// Replaces this process by the program `name` (exec); does not return. The program is in
// ../libexec/grove (installed) or in the folder of this program (build folder). Throws InputError
// if the program does not exist or cannot be run; if it does not exist, the message names
// `package`, the Debian package that contains it.
[[noreturn]] void exec_program(const std::string& name, const std::vector<std::string>& arguments,
                               const std::string& package = "grove");

}  // namespace grove::detail
