// SPDX-License-Identifier: MIT
// Generates manual pages and shell completions from a program's CommandText.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/common/command_text.h"

namespace grove::detail {

inline constexpr const char* kShells[] = {"bash", "zsh", "fish"};

// Returns the completion script for `program`. `shell`: one of kShells.
std::string completion_script(const CommandText& program, const std::string& shell);

struct ManualPage {
  std::string name;  // "grove-solve.1"
  std::string text;  // in roff
};
// Returns one page for the program and one for each command. The page of a command includes its
// subcommands.
std::vector<ManualPage> manual_pages(const CommandText& program, const std::string& version);

}  // namespace grove::detail
