// SPDX-License-Identifier: MIT
// Manual pages and shell completions, made from a program's table of commands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/common/command_text.h"

namespace grove::detail {

inline constexpr const char* kShells[] = {"bash", "zsh", "fish"};

// Returns the completion script of this program for one of kShells.
std::string completion_script(const CommandText& program, const std::string& shell);

struct ManualPage {
  std::string name;  // "grove-solve.1"
  std::string text;  // roff, for man
};
// Returns a page of the program and one of each command. The page of a command includes its
// subcommands.
std::vector<ManualPage> manual_pages(const CommandText& program, const std::string& version);

}  // namespace grove::detail
