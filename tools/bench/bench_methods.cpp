// SPDX-License-Identifier: MIT
#include "tools/bench/bench_methods.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <sstream>
#include <string_view>

#include "io/input_error.h"
#include "tools/common/parse_error.h"
#include "tools/common/program.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {
namespace {

using Words = std::vector<std::string>;

constexpr const char* kInstance = "INSTANCE";  // placeholder for the required argument

Words words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

[[noreturn]] void refuse_method(const std::string& text, const std::string& why) {
  throw CLI::ValidationError(fmt::format("--run '{}'", one_line(text)), why);
}

struct NameAndOptions {
  std::string name;
  Words words;
};

// Splits "NAME: OPTIONS" at the first colon. Restricts the characters of NAME, because it becomes
// part of file names and tables.
NameAndOptions split(const std::string& text) {
  const std::size_t colon = text.find(':');
  const Words name = words_of(text.substr(0, colon));
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-_.+=").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (name.size() != 1 || !std::ranges::all_of(name[0], is_plain) ||
      std::isalnum(static_cast<unsigned char>(name[0][0])) == 0)
    refuse_method(text,
                  "expected 'NAME: OPTIONS OF grove solve', where NAME consists of letters, digits "
                  "and -_.+= and begins with a letter or a digit");
  if (colon == std::string::npos) return {name[0], {"--method", name[0]}};
  return {name[0], words_of(text.substr(colon + 1))};
}

// Returns the options of `grove solve` that a run must not set: those for the instance,
// checkpoints, log and other files.
std::set<std::string> file_options() {
  CLI::App app;
  SolveArguments unused;
  unused.instance.add_to(app);
  add_checkpoint_options(app, unused.checkpoints);
  add_file_options(app, unused);
  std::set<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_positional()) names.insert(option->get_name());
  return names;
}

void refuse_file_options(const CLI::App& app, const std::string& text) {
  for (const std::string& name : file_options())
    if (app.count(name) > 0)
      refuse_method(text, name + " is not allowed here; the benchmark chooses the files of a run");
}

// Returns the options that the user gave for the run as command-line words, without --time-limit.
Words given_arguments(const CLI::App& app) {
  Words words;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_positional() || option->get_name() == "--time-limit")
      continue;
    words.push_back(option->get_name());
    const bool is_flag = option->get_expected_max() == 0;
    if (!is_flag) words.push_back(fmt::format("{}", fmt::join(option->reduced_results(), ",")));
  }
  return words;
}

void add_default(Words& words, const CLI::App& app, const std::string& option,
                 const std::string& value) {
  if (app.count(option) == 0) words.insert(words.end(), {option, value});
}

}  // namespace

bench::Method read_run(const std::string& text, const RunDefaults& defaults) {
  const NameAndOptions given = split(text);
  CLI::App app;
  let_last_option_win(app);
  SolveArguments a;
  a.time_limit_s = defaults.time_limit_s;
  a.seed = defaults.seed;
  a.threads = 1;
  add_solve_options(app, a);
  Words words{kInstance};
  words.insert(words.end(), given.words.begin(), given.words.end());
  std::ranges::reverse(words);  // CLI11 parses from the back
  bench::Method method;
  try {
    app.parse(words);
  } catch (const CLI::Success&) {
    refuse_method(text, "found a request for help; expected options of a search");
  } catch (const CLI::ParseError& error) {
    refuse_method(text, parse_error_text(app, error));
  }
  refuse_file_options(app, text);
  try {
    method.settings = {.method = given.name,
                       .options = fmt::format("{}", fmt::join(given.words, " ")),
                       .omega = solve_options(a).omega.to_string(),
                       .seed = a.seed,
                       .time_limit_s = a.time_limit_s,
                       .memory_limit_gb = defaults.memory_limit_gb};
  } catch (const CLI::ValidationError& error) {  // conflicting options
    refuse_method(text, error.what());
  }
  method.threads = a.threads;
  std::optional<double>& memory_limit_gb = method.settings.memory_limit_gb;
  if (app.count("--memory-limit") > 0) memory_limit_gb = a.memory_limit_gb;
  method.arguments = given_arguments(app);
  add_default(method.arguments, app, "--threads", "1");
  add_default(method.arguments, app, "--seed", std::to_string(a.seed));
  if (memory_limit_gb)
    add_default(method.arguments, app, "--memory-limit", fmt::format("{}", *memory_limit_gb));
  return method;
}

std::vector<bench::Method> read_runs(const std::vector<std::string>& texts,
                                     const RunDefaults& defaults) {
  std::vector<bench::Method> methods;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    methods.push_back(read_run(text, defaults));
    if (!names.insert(methods.back().settings.method).second)
      refuse_method(text, "found a second run of that name; expected distinct names");
  }
  return methods;
}

}  // namespace grove::detail
