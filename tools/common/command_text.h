// SPDX-License-Identifier: MIT
// What a program says of its commands and options, as data: help, manual pages and the completions
// of shells are made of the one table that the command line is parsed by.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grove::detail {

struct OptionText {
  std::vector<std::string> names;  // "-o", "--output"; of a positional: "INSTANCE"
  std::string value;               // "FILE.html"; empty: takes none
  std::string description;         // in one line
  std::string preset;              // the default; empty: none
  std::vector<std::string> choices;
  bool is_positional = false;
};

struct CommandText {
  std::string name;         // "grove generate map"
  std::string word;         // "map"
  std::string description;  // the first line of a program's: in one sentence
  std::string footer;
  std::vector<OptionText> options;  // those in its help
  std::vector<CommandText> commands;

  // "[OPTIONS] INSTANCE".
  std::string usage() const;
};

CommandText command_text(const CLI::App& app);

}  // namespace grove::detail
