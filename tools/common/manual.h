// SPDX-License-Identifier: MIT
// Manual pages and the completions of shells, from a program's own table of commands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/common/command_text.h"

namespace grove::detail {

inline constexpr const char* kShells[] = {"bash", "zsh", "fish"};

// The script that completes this program's words, for one of kShells.
std::string completion_script(const CommandText& program, const std::string& shell);

struct ManualPage {
  std::string name;  // "grove-solve.1"
  std::string text;  // for man
};
// One of the program and one of each of its commands; what a command has below it is in its page.
std::vector<ManualPage> manual_pages(const CommandText& program, const std::string& version);

}  // namespace grove::detail
