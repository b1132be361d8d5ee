// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "tools/common/manual.h"

namespace grove::detail {
namespace {

// Escapes text for roff, so that no line becomes a request and each '-' stays a minus sign.
std::string plain(const std::string& text) {
  std::string made;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) made += "\\&";
    begins = c == '\n';
    if (c == '\\')
      made += "\\e";
    else if (c == '-')
      made += "\\-";
    else
      made += c;
  }
  return made;
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}

std::string page_name(const CommandText& command) {
  std::string name = command.name;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string option_lines(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) names += " \\fI" + plain(option.value) + "\\fR";
  const std::string default_value =
      option.default_value.empty() ? "" : " [" + option.default_value + "]";
  return ".TP\n" + names + "\n" + plain(option.description + default_value) + "\n";
}

std::string option_section(const CommandText& command) {
  std::string text;
  for (const bool positional : {true, false})
    for (const OptionText& option : command.options)
      if (option.is_positional == positional) text += option_lines(option);
  return text;
}

// Converts a footer to roff. Keeps its paragraphs, and the layout of indented lines.
std::string footer_text(const std::string& footer) {
  std::istringstream lines(footer);
  std::string text;
  bool laid_out = false;
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.starts_with("  ");
    if (indented != laid_out) text += indented ? ".nf\n" : ".fi\n";
    laid_out = indented;
    text += line.empty() ? ".PP\n" : plain(line) + "\n";
  }
  return text + (laid_out ? ".fi\n" : "");
}

std::string command_section(const CommandText& command) {
  std::string text =
      fmt::format(".SH {}\n{}\n.PP\n{} {}\n", plain(command.name), plain(command.description),
                  bold(command.name), plain(command.usage()));
  text += option_section(command);
  if (!command.footer.empty()) text += ".PP\n" + footer_text(command.footer);
  for (const CommandText& below : command.commands) text += command_section(below);
  return text;
}

// Returns the beginning of the description up to the first '.' or ':', for the NAME section.
std::string summary_of(const CommandText& command) {
  return command.description.substr(0, command.description.find_first_of(".:"));
}

std::string begin_of(const CommandText& command, const std::string& version) {
  return fmt::format(
      ".TH {} 1 \"\" \"{}\" \"Grove\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{} {}\n"
      ".SH DESCRIPTION\n{}\n",
      page_name(command), version, plain(page_name(command)), plain(summary_of(command)),
      bold(command.name), plain(command.usage()), plain(command.description));
}

ManualPage page_of(const CommandText& command, const std::string& version) {
  std::string text = begin_of(command, version);
  if (command.options.empty())
    text += ".PP\nIts options: " + bold(command.name + " --help") + "\n";
  else
    text += ".SH OPTIONS\n" + option_section(command);
  if (!command.footer.empty()) text += ".SH NOTES\n" + footer_text(command.footer);
  for (const CommandText& below : command.commands) text += command_section(below);
  return {page_name(command) + ".1", text};
}

ManualPage program_page(const CommandText& program, const std::string& version) {
  std::string text = begin_of(program, version) + ".SH COMMANDS\n";
  for (const CommandText& command : program.commands)
    text += fmt::format(".TP\n{}(1)\n{}\n", bold(page_name(command)), plain(command.description));
  text += ".SH OPTIONS\n" + option_section(program);
  text += ".SH NOTES\n" + footer_text(program.footer);
  return {page_name(program) + ".1", text};
}

}  // namespace

std::vector<ManualPage> manual_pages(const CommandText& program, const std::string& version) {
  if (program.commands.empty()) return {page_of(program, version)};
  std::vector<ManualPage> pages{program_page(program, version)};
  for (const CommandText& command : program.commands) pages.push_back(page_of(command, version));
  return pages;
}

}  // namespace grove::detail
