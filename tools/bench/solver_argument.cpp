// SPDX-License-Identifier: MIT
// Parses --solver NAME=COMMAND: finds the adapter and the program.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "io/input_error.h"
#include "tools/bench/external_solver.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw CLI::ValidationError(fmt::format("--solver '{}'", one_line(text)), why);
}

// Returns the folder of the shipped adapters: the installed folder if it exists, otherwise the
// folder beside the program.
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
    return std::isalnum(c) != 0 ||
           std::string_view("-_.+").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (equals == std::string::npos || name.empty() || !std::ranges::all_of(name, is_plain) ||
      std::isalnum(static_cast<unsigned char>(name[0])) == 0)
    throw CLI::ValidationError(fmt::format("{} '{}'", option, one_line(argument)),
                               "expected NAME=..., where NAME consists of letters, digits and -_.+ "
                               "and begins with a letter or a digit");
  return {name, argument.substr(equals + 1)};
}

SolverAdapter adapter_called(const std::string& name, const std::string& text) {
  const fs::path file =
      name.ends_with(".json") ? fs::path(name) : adapter_folder() / (name + ".json");
  if (!name.ends_with(".json") && !fs::exists(file))
    refuse(text,
           fmt::format("no adapter is called '{}'; expected one of {}, a file FILE.json, or a "
                       "command with placeholders such as {{instance}} and {{output}}",
                       one_line(name), fmt::join(known_adapters(), ", ")));
  return read_solver(file);
}

// Returns the absolute path of a program. Searches PATH unless `program` contains a '/'. Refuses
// the first file with that name if it is not executable.
std::string path_of_program(const std::string& program, const std::string& text) {
  std::error_code error;
  const bool is_path = program.find('/') != std::string::npos;
  const char* folders = std::getenv("PATH");
  for (const std::string& folder :
       CLI::detail::split(is_path || folders == nullptr ? "" : folders, ':'))
    if (const fs::path path = fs::path(folder) / program; fs::is_regular_file(path, error)) {
      if (::access(path.c_str(), X_OK) == 0) return fs::absolute(path).string();
      refuse(text,
             fmt::format("{} is not executable; expected a program", one_line(path.string())));
    }
  refuse(text, fmt::format("there is no program {}{}", one_line(program),
                           is_path ? "" : " in the folders of PATH"));
}

bool is_whole_command(const std::vector<std::string>& words) {
  return names(words, "instance") || names(words, "map") || names(words, "scenario");
}

ExternalSolver solver_of_command(const std::string& name, std::vector<std::string> words,
                                 const std::string& text) {
  ExternalSolver solver{.adapter = {.name = name}, .program = path_of_program(words[0], text)};
  words[0] = "{program}";
  SolverAdapter& adapter = solver.adapter;
  adapter.input = names(words, "instance") ? SolverInput::kGrove : SolverInput::kMovingAi;
  if (!names(words, "output")) adapter.plan.clear();
  adapter.command = std::move(words);
  if (const std::string mistake = input_mistake(adapter.input, adapter.command); !mistake.empty())
    refuse(text, mistake);
  return solver;
}

// Removes `option` and its value from the adapter's command, so that the user's option replaces it;
// many programs refuse an option given twice.
void drop_option(std::vector<std::string>& command, const std::string& option) {
  if (!option.starts_with('-')) return;
  const auto it = std::ranges::find(command, option);
  if (it == command.end()) return;
  const bool has_value = it + 1 != command.end() && !(it + 1)->starts_with('-');
  command.erase(it, it + (has_value ? 2 : 1));
}

// Builds the solver for "NAME=PROGRAM", which uses the adapter NAME, or "NAME=ADAPTER:PROGRAM".
ExternalSolver solver_of_adapter(const std::string& name, const std::vector<std::string>& words,
                                 const std::string& text) {
  const std::size_t colon = words[0].find(':');
  const bool is_named = colon != std::string::npos;
  ExternalSolver solver{
      .adapter = adapter_called(is_named ? words[0].substr(0, colon) : name, text),
      .program = path_of_program(is_named ? words[0].substr(colon + 1) : words[0], text)};
  for (std::size_t i = 1; i < words.size(); ++i) drop_option(solver.adapter.command, words[i]);
  solver.adapter.command.insert(solver.adapter.command.end(), words.begin() + 1, words.end());
  return solver;
}

NamedSolver read_solver_argument(const std::string& text) {
  const NamedText given = split(text, "--solver");
  if (const std::string mistake = template_mistake(given.text); !mistake.empty())
    refuse(text, mistake);
  const auto words = command_words(given.text);
  if (!words) refuse(text, "a quote is not closed");
  if (words->empty()) refuse(text, "expected a command after the name");
  NamedSolver made{.name = given.name, .options = {}, .solver = {}};
  const bool is_whole = is_whole_command(*words);
  made.solver = is_whole ? solver_of_command(given.name, *words, text)
                         : solver_of_adapter(given.name, *words, text);
  made.options =
      is_whole ? fs::path(made.solver.program).filename().string() : made.solver.adapter.name;
  for (std::size_t i = 1; i < words->size(); ++i) made.options += " " + (*words)[i];
  return made;
}

void add_claim(std::vector<NamedSolver>& solvers, const std::string& claim) {
  const NamedText given = split(claim, "--claimed-cost");
  const auto place = fmt::format("--claimed-cost '{}'", one_line(claim));
  const auto it = std::ranges::find(solvers, given.name, &NamedSolver::name);
  if (it == solvers.end())
    throw CLI::ValidationError(place, "expected the name of a --solver before the =");
  if (const std::string mistake = regex_mistake(given.text, 1); !mistake.empty())
    throw CLI::ValidationError(place, mistake);
  it->solver.adapter.cost = LinePattern{.file = "", .regex = given.text};
}

void require_something_to_read(const NamedSolver& solver) {
  const SolverAdapter& adapter = solver.solver.adapter;
  if (adapter.plan.empty() && !adapter.cost && !adapter.solved)
    refuse(solver.name, fmt::format("has no {{output}} for a plan and no pattern for a cost; "
                                    "expected {{output}}, or --claimed-cost '{}=REGEX'",
                                    solver.name));
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

std::vector<NamedSolver> read_solver_arguments(const std::vector<std::string>& solvers,
                                               const std::vector<std::string>& claims) {
  std::vector<NamedSolver> made;
  for (const std::string& text : solvers) made.push_back(read_solver_argument(text));
  for (const std::string& claim : claims) add_claim(made, claim);
  std::ranges::for_each(made, require_something_to_read);
  return made;
}

}  // namespace grove::detail::bench
