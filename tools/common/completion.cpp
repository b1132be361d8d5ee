// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "tools/common/manual.h"

namespace grove::detail {
namespace {

using Words = std::vector<std::string>;

void for_each_command(const CommandText& command,
                      const std::function<void(const CommandText&)>& act) {
  act(command);
  for (const CommandText& below : command.commands) for_each_command(below, act);
}

std::string function_name(const CommandText& program) {
  std::string name = "_" + program.name;
  std::ranges::replace(name, '-', '_');
  return name;
}

Words option_names(const CommandText& command) {
  Words names;
  for (const OptionText& option : command.options)
    if (!option.is_positional) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

Words command_words(const CommandText& command) {
  Words words;
  for (const CommandText& below : command.commands) words.push_back(below.word);
  return words;
}

// --- bash ---

std::string bash_words(const CommandText& command) {
  return fmt::format("    \"{}\") words=\"{}\"; options=\"{}\" ;;\n", command.name,
                     fmt::join(command_words(command), " "), fmt::join(option_names(command), " "));
}

// Returns the cases of the script that list the values of each option.
std::string bash_values(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options) {
    if (option.value.empty()) continue;
    Words patterns;
    for (const std::string& name : option.names)
      patterns.push_back(fmt::format("\"{} {}\"", command.name, name));
    text += fmt::format("    {}) values=\"{}\"; takes=yes ;;\n", fmt::join(patterns, "|"),
                        fmt::join(option.choices, " "));
  }
  return text;
}

std::string bash_script(const CommandText& program) {
  std::string paths, words, values;
  for_each_command(program, [&](const CommandText& command) {
    if (&command != &program)
      paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", command.name);
    words += bash_words(command);
    values += bash_values(command);
  });
  const std::string walk = paths.empty() ? ""
                                         : fmt::format(R"(  local i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$path ${{COMP_WORDS[i]}}" in {}) path+=" ${{COMP_WORDS[i]}}" ;; esac
  done
)",
                                                       paths);
  return fmt::format(R"(# bash completion of {0}
{1}() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} path={0}
  local words= options= values= takes=
{2}  case "$path $prev" in
{3}  esac
  if [[ $takes ]]; then
    if [[ $values ]]; then COMPREPLY=($(compgen -W "$values" -- "$cur")); fi
    return
  fi
  case "$path" in
{4}  esac
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
  elif [[ $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$cur"))
  fi
}}
complete -o bashdefault -o default -F {1} {0}
)",
                     program.name, function_name(program), walk, values, words);
}

// --- zsh ---

// Escapes text for zsh within '...[...]'.
std::string zsh_quoted(const std::string& text) {
  std::string made;
  for (const char c : text) {
    if (c == '\'')
      made += "'\\''";
    else if (c == '[' || c == ']' || c == ':')
      made += std::string("\\") + c;
    else
      made += c;
  }
  return made;
}

std::string zsh_options(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options) {
    if (option.is_positional) continue;
    std::string value;
    if (!option.value.empty())
      value = option.choices.empty() ? fmt::format(":{}:_files", zsh_quoted(option.value))
                                     : fmt::format(":{}:({})", zsh_quoted(option.value),
                                                   fmt::join(option.choices, " "));
    for (const std::string& name : option.names)
      text += fmt::format(" \\\n        '*{}[{}]{}'", name, zsh_quoted(option.description), value);
  }
  return text;
}

std::string zsh_case(const CommandText& command) {
  if (command.commands.empty())
    return fmt::format("    \"{}\")\n      _arguments{} \\\n        '*:file:_files' ;;\n",
                       command.name, zsh_options(command));
  std::string words;
  for (const CommandText& below : command.commands)
    words += fmt::format(" '{}:{}'", below.word, zsh_quoted(below.description));
  return fmt::format(
      "    \"{}\")\n      local -a words=({})\n      if [[ $PREFIX == -* ]]; then\n"
      "        _arguments{}\n      else\n        _describe command words\n      fi ;;\n",
      command.name, words, zsh_options(command));
}

std::string zsh_script(const CommandText& program) {
  std::string paths, cases;
  for_each_command(program, [&](const CommandText& command) {
    if (&command != &program)
      paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", command.name);
    cases += zsh_case(command);
  });
  const std::string walk = paths.empty() ? ""
                                         : fmt::format(R"(  local -i i
  for ((i = 2; i < CURRENT; i++)); do
    case "$path_words $words[i]" in
      ({}) path_words+=" $words[i]"; shift_by=$((i - 1)) ;;
    esac
  done
  words=("${{(@)words[$((shift_by + 1)),-1]}}")
  (( CURRENT -= shift_by ))
)",
                                                       paths);
  return fmt::format(R"(#compdef {0}
{1}() {{
  local path_words={0}
  local -i shift_by=0
{2}  case "$path_words" in
{3}  esac
}}
{1} "$@"
)",
                     program.name, function_name(program), walk, cases);
}

// --- fish ---

std::string fish_quoted(const std::string& text) {
  std::string made;
  for (const char c : text) {
    if (c == '\'' || c == '\\') made += '\\';
    made += c;
  }
  return "'" + made + "'";
}

// Returns the fish option -n with the condition that the command line contains the words of this
// command and of none of its subcommands; "" if there is no condition.
std::string fish_condition(const CommandText& program, const CommandText& command) {
  std::string condition;
  for (const std::string& word : CLI::detail::split(command.name, ' '))
    if (word != program.word)
      condition += fmt::format("__fish_seen_subcommand_from {}; and ", word);
  if (!command.commands.empty())
    condition +=
        fmt::format("not __fish_seen_subcommand_from {}", fmt::join(command_words(command), " "));
  else if (condition.size() > 6)
    condition.resize(condition.size() - 6);
  return condition.empty() ? "" : " -n " + fish_quoted(condition);
}

std::string fish_option(const OptionText& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.value.empty()) text += option.choices.empty() ? " -r" : " -x";
  if (!option.choices.empty()) text += fmt::format(" -a '{}'", fmt::join(option.choices, " "));
  return text + " -d " + fish_quoted(option.description);
}

std::string fish_script(const CommandText& program) {
  std::string text = "# fish completion of " + program.name + "\n";
  for_each_command(program, [&](const CommandText& command) {
    const std::string condition = fish_condition(program, command);
    for (const CommandText& below : command.commands)
      text += fmt::format("complete -c {}{} -f -a {} -d {}\n", program.name, condition, below.word,
                          fish_quoted(below.description));
    for (const OptionText& option : command.options)
      if (!option.is_positional)
        text += fmt::format("complete -c {}{}{}\n", program.name, condition, fish_option(option));
  });
  return text;
}

}  // namespace

std::string completion_script(const CommandText& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  return shell == "zsh" ? zsh_script(program) : fish_script(program);
}

}  // namespace grove::detail
