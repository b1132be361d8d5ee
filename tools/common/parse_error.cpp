// SPDX-License-Identifier: MIT
#include "tools/common/parse_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/spelling.h"

namespace grove::detail {
namespace {

using Words = std::vector<std::string>;

Words commands_of(const CLI::App& app) {
  Words names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

Words options_of(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// Returns "; expected one of ..." with the commands, if any, below `command`. The program itself
// has too many commands for one line; its help lists them.
std::string expected_commands(const CLI::App& command) {
  if (command.get_parent() == nullptr || commands_of(command).empty()) return "";
  return fmt::format("; expected one of {}", fmt::join(commands_of(command), ", "));
}

std::string unknown_text(const CLI::App& command) {
  const Words words = command.remaining();
  const auto option =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) return fmt::format("unexpected argument '{}'", words.front());
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("unknown option '{}'{}", name, suggestion(name, options_of(command)));
}

}  // namespace

std::string suggestion(const std::string& word, const Words& known) {
  const auto nearest = nearest_word(word, {known.begin(), known.end()});
  return nearest ? fmt::format("; did you mean '{}'?", *nearest) : "";
}

std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error) {
  const bool wants_command = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr &&
                             command.get_require_subcommand_min() > 0;
  if (command.remaining_size() == 0)
    return wants_command ? fmt::format("a command is required{}", expected_commands(command))
                         : error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unknown_text(command);
  if (!wants_command) return error.what();  // else this text would not name the word
  return unknown_command_text(command, command.remaining().front());
}

std::string misplaced_command_text(const CLI::App& program, const Words& words) {
  if (!words.empty() && words.front() == "help") return {};
  const CLI::App* command = &program;
  std::string name = program.get_name();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Words commands = commands_of(*command);
    const auto names_one = [&](const std::string& word) {
      return std::ranges::find(commands, word) != commands.end();
    };
    const auto named =
        std::find_if(words.begin() + static_cast<std::ptrdiff_t>(i), words.end(), names_one);
    if (named == words.end()) return {};
    if (named != words.begin() + static_cast<std::ptrdiff_t>(i))
      return fmt::format(
          "found '{}' before the command; expected '{} {} ...', options and files "
          "after it",
          words[i], name, *named);
    name += " " + words[i];
    command = command->get_subcommand(words[i]);
  }
  return {};
}

std::string unknown_command_text(const CLI::App& command, const std::string& word) {
  const std::string similar = suggestion(word, commands_of(command));
  return fmt::format("unknown command '{}'{}", word,
                     similar.empty() ? expected_commands(command) : similar);
}

}  // namespace grove::detail
