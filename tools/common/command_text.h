// SPDX-License-Identifier: MIT
// Descriptions of a program's commands and options as data, taken from the CLI11 objects that parse
// the command line. Manual pages and shell completions are generated from them.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grove::detail {

struct OptionText {
  std::vector<std::string> names;    // "-o", "--output"; for a positional argument "INSTANCE"
  std::string value;                 // "FILE.html"; "" for a flag or a positional argument
  std::string description;           // one line
  std::string default_value;         // default value; "" if there is none
  std::vector<std::string> choices;  // accepted values; empty if not a fixed list
  bool is_positional = false;
};

struct CommandText {
  std::string name;         // full name: "grove generate map"
  std::string word;         // last word of the name: "map"
  std::string description;  // one line
  std::string footer;
  std::vector<OptionText> options;  // without options that are hidden from the help
  std::vector<CommandText> commands;

  // Returns the arguments in the usage line, such as "[OPTIONS] INSTANCE".
  std::string usage() const;
};

// Returns the description of `app` and, recursively, of its subcommands.
CommandText command_text(const CLI::App& app);

}  // namespace grove::detail
