// SPDX-License-Identifier: MIT
// What was wrong with a command line, in words.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grove::detail {

// `error` came up while `command` was being parsed. CLI11's words, but for a command, an option or
// an argument that is not known: that is named, and of options and commands the one that resembles
// it.
std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error);

// "; did you mean 'KNOWN'?", of the known word that resembles this one; empty if none does.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

// That the words of a command line name a command, but not first: "my.cts.json solve"; empty if
// they do not.
std::string misplaced_command_text(const CLI::App& program, const std::vector<std::string>& words);

// That `command` has no such subcommand, and which one resembles it.
std::string unknown_command_text(const CLI::App& command, const std::string& word);

}  // namespace grove::detail
