// SPDX-License-Identifier: MIT
// Descriptions of a program's commands and options as data. Help, manual pages and shell
// completions are made from the table by which the command line is parsed.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grove::detail {

struct OptionText {
  std::vector<std::string> names;  // "-o", "--output"; of a positional argument: "INSTANCE"
  std::string value;               // "FILE.html"; "" for a flag
  std::string description;         // in one line
  std::string preset;              // default value; "" if there is none
  std::vector<std::string> choices;
  bool is_positional = false;
};

struct CommandText {
  std::string name;         // "grove generate map"
  std::string word;         // "map"
  std::string description;  // of a program: the first sentence
  std::string footer;
  std::vector<OptionText> options;  // those that its help shows
  std::vector<CommandText> commands;

  // "[OPTIONS] INSTANCE".
  std::string usage() const;
};

CommandText command_text(const CLI::App& app);

}  // namespace grove::detail
