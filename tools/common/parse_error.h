// SPDX-License-Identifier: MIT
// Messages about errors in a command line.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grove::detail {

// Returns a message for `error`, which occurred while `command` was parsed. It is CLI11's text,
// except for unknown commands, options and arguments: then it names the word and, for options and
// commands, the most similar known one.
std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error);

// Returns "; did you mean 'KNOWN'?" with the most similar known word; "" if none is similar.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

// Returns a message if the words of a command line name a command that is not the first word
// ("my.cts.json solve"); otherwise "".
std::string misplaced_command_text(const CLI::App& program, const std::vector<std::string>& words);

// Returns a message that `command` has no such subcommand, with the most similar one.
std::string unknown_command_text(const CLI::App& command, const std::string& word);

}  // namespace grove::detail
