// SPDX-License-Identifier: MIT
#include "tools/common/command_text.h"

#include <algorithm>
#include <sstream>

namespace grove::detail {
namespace {

std::string one_line_of(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

// Returns the choices that the name of a value lists: "auto|fixed|free"; none for other names.
std::vector<std::string> choices_of(const std::string& value) {
  const bool is_list = value.find('|') != std::string::npos &&
                       std::ranges::none_of(value, [](char c) { return c >= 'A' && c <= 'Z'; });
  return is_list ? CLI::detail::split(value, '|') : std::vector<std::string>{};
}

OptionText option_text(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  text.is_positional = text.names.empty();
  if (text.is_positional) text.names.push_back(option.get_name());
  if (option.get_items_expected_max() > 0 && !text.is_positional)
    text.value = option.get_type_name();
  text.description = one_line_of(option.get_description());
  text.default_value = option.get_default_str();
  text.choices = choices_of(text.value);
  return text;
}

bool is_in_help(const CLI::Option& option) {
  return !option.get_description().empty();
}

CommandText text_of(const CLI::App& app, const std::string& above) {
  CommandText text{.name = above + app.get_name(),
                   .word = app.get_name(),
                   .description = one_line_of(app.get_description()),
                   .footer = app.get_footer(),
                   .options = {},
                   .commands = {}};
  for (const CLI::Option* option : app.get_options())
    if (is_in_help(*option)) text.options.push_back(option_text(*option));
  for (const CLI::App* command : app.get_subcommands({}))
    text.commands.push_back(text_of(*command, text.name + " "));
  return text;
}

}  // namespace

std::string CommandText::usage() const {
  std::string text = "[OPTIONS]";
  for (const OptionText& option : options)
    if (option.is_positional) text += " " + option.names.front();
  return commands.empty() ? text : text + " COMMAND";
}

CommandText command_text(const CLI::App& app) {
  return text_of(app, "");
}

}  // namespace grove::detail
