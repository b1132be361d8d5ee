// SPDX-License-Identifier: MIT
// --solver NAME=COMMAND: which adapter and which program it means.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "grove/detail/io/input_error.h"
#include "tools/bench/foreign_solver.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw CLI::ValidationError(fmt::format("--solver '{}'", one_line(text)), why);
}

// Beside the program, or where it is installed.
fs::path adapter_folder() {
  const fs::path own = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path installed = own.parent_path() / "share/grove/solvers";
  return fs::exists(installed) ? installed : own / "solvers";
}

struct NamedText {
  std::string name;
  std::string text;
};

NamedText split(const std::string& argument, const std::string& option) {
  const std::size_t equals = argument.find('=');
  const std::string name = argument.substr(0, equals);
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_.+").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (equals == std::string::npos || name.empty() || !std::ranges::all_of(name, is_plain) ||
      std::isalnum(static_cast<unsigned char>(name[0])) == 0)
    throw CLI::ValidationError(fmt::format("{} '{}'", option, one_line(argument)),
                               "expected NAME=..., the name of letters, digits and -_.+");
  return {name, argument.substr(equals + 1)};
}

SolverAdapter adapter_called(const std::string& name, const std::string& text) {
  const fs::path file = name.ends_with(".json") ? fs::path(name) : adapter_folder() / (name + ".json");
  if (!name.ends_with(".json") && !fs::exists(file))
    refuse(text, fmt::format("no adapter is called '{}'; expected one of {}, a file FILE.json, or a "
                             "command with places such as {{instance}} and {{output}}",
                             one_line(name), fmt::join(known_adapters(), ", ")));
  return read_solver(file);
}

// "eecbs:/opt/eecbs": an adapter before the first colon, if it looks like one.
std::pair<std::string, std::string> adapter_and_program(const std::string& word,
                                                        const std::string& name) {
  const std::size_t colon = word.find(':');
  if (colon == std::string::npos) return {name, word};
  return {word.substr(0, colon), word.substr(colon + 1)};
}

// Found as a shell would.
std::string existing_program(const std::string& program, const std::string& text) {
  if (program.find('/') != std::string::npos) {
    std::error_code error;
    if (fs::is_regular_file(program, error)) return fs::absolute(program).string();
    refuse(text, fmt::format("there is no program {}", one_line(program)));
  }
  const char* folders = std::getenv("PATH");
  for (const std::string& folder : CLI::detail::split(folders != nullptr ? folders : "", ':'))
    if (fs::exists(fs::path(folder) / program)) return program;
  refuse(text, fmt::format("there is no program '{}' where the shell looks for programs", one_line(program)));
}

bool is_used(const SolverAdapter& adapter, std::string_view place) {
  const auto names = placeholders(adapter.command);
  return std::ranges::find(names, place) != names.end();
}

SolverAdapter adapter_of_command(const NamedText& given, const std::string& text) {
  if (const std::string mistake = template_mistake(given.text); !mistake.empty()) refuse(text, mistake);
  SolverAdapter adapter;
  adapter.name = given.name;
  adapter.command = given.text;
  adapter.input = is_used(adapter, "instance") ? SolverInput::kGrove : SolverInput::kMovingAi;
  if (is_used(adapter, "instance") && (is_used(adapter, "map") || is_used(adapter, "scenario")))
    refuse(text, "expected {instance}, or {map} and {scenario}, and not both");
  if (!is_used(adapter, "output") && !is_used(adapter, "folder")) adapter.plan.clear();
  return adapter;
}

}  // namespace

std::vector<std::string> known_adapters() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(adapter_folder(), error))
    if (item.path().extension() == ".json") names.push_back(item.path().stem().string());
  std::ranges::sort(names);
  return names;
}

NamedSolver read_solver_argument(const std::string& text, const std::vector<std::string>& claims) {
  const NamedText given = split(text, "--solver");
  auto words = command_words(given.text);
  if (!words) refuse(text, "a quote is not closed");
  if (words->empty()) refuse(text, "expected a command after the name");
  NamedSolver made{.name = given.name, .options = {}, .solver = {}};
  ForeignSolver& solver = made.solver;
  if (given.text.find('{') != std::string::npos && words->front().find(':') == std::string::npos) {
    solver.adapter = adapter_of_command(given, text);
    existing_program(words->front(), text);
    made.options = fs::path(words->front()).filename().string();
  } else {
    const auto [adapter, program] = adapter_and_program(words->front(), given.name);
    solver.adapter = adapter_called(adapter, text);
    solver.program = existing_program(program, text);
    solver.more.assign(words->begin() + 1, words->end());
    made.options = solver.adapter.name;
    for (const std::string& word : solver.more)
      if (const std::string mistake = template_mistake(word); !mistake.empty()) refuse(text, mistake);
  }
  for (std::size_t i = 1; i < words->size(); ++i) made.options += " " + (*words)[i];
  for (const std::string& claim : claims) {
    const NamedText regex = split(claim, "--claimed-cost");
    if (regex.name == given.name) solver.adapter.cost = LinePattern{.file = "", .regex = regex.text};
  }
  if (solver.adapter.plan.empty() && !solver.adapter.cost && !solver.adapter.solved)
    refuse(text, fmt::format("writes no plan to {{output}}, and nothing says what to read instead; expected "
                             "{{output}}, or --claimed-cost '{}=REGEX'", given.name));
  return made;
}

}  // namespace grove::detail::bench
