// SPDX-License-Identifier: MIT
// Error messages for invalid command lines.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace grove::detail {

// Returns a message for `error`, which CLI11 threw while it parsed `command`. For an unknown
// command or option the message names the word and the most similar known one; for an unexpected
// argument it names the word. Otherwise it is CLI11's text.
std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error);

// Returns "; did you mean 'KNOWN'?" with the word in `known` most similar to `word`; "" if none is
// similar.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

// Returns a message if a command on the command line is preceded by words that are not commands
// ("my.cts.json solve"); otherwise "".
std::string misplaced_command_text(const CLI::App& program, const std::vector<std::string>& words);

// Returns a message that `command` has no subcommand `word`, with the most similar subcommand.
std::string unknown_command_text(const CLI::App& command, const std::string& word);

}  // namespace grove::detail
