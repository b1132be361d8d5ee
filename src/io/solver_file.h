// SPDX-License-Identifier: MIT
// Adapters: files that describe how to run another solver, and how to read its results
// (docs/benchmarking.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// The format in which a solver reads an instance.
enum class SolverInput : std::uint8_t {
  kMovingAi,        // {map}, {scenario}, {agents}: classical MAPF
  kGrove,           // {instance}, a *.cts.json: every instance of Grove
  kLibmrp,          // {instance}, YAML of libMultiRobotPlanning: classical MAPF
  kPotentialGoals,  // {instance}, the same with one potential goal per agent: ITA-CBS, CBS-TA
  kMgcbs,           // {instance}, YAML with lists of goals: MG-MAPF
};

// A pattern for a line with a result. The last line in which the expression is found counts. (Of a
// line longer than kMaxLineLength only the beginning is searched: such a line is a path and not a
// claim, and libstdc++'s regular expressions are recursive.)
inline constexpr std::size_t kMaxLineLength = 4096;
struct LinePattern {
  std::string file;   // a template; empty: the standard output of the program
  std::string regex;  // ECMAScript
  double scale = 1;   // factor for the number in group 1: 0.001 for milliseconds
};

// The meaning of group k of an expression, from k = 1.
enum class TraceGroup : std::uint8_t {
  kSeconds,
  kMilliseconds,
  kSecondsLeft,  // remaining time
  kCost,
  kLowerBound
};

// Each line in which the expression is found reports a plan found before the end.
struct TracePattern {
  LinePattern line;
  std::vector<TraceGroup> groups;  // one of them is a time, one the cost
};

struct SolverAdapter {
  std::string name;                       // letters, digits and -_.+=
  std::string about = {};                 // description
  std::vector<std::string> command = {};  // templates; {program} is the program
  SolverInput input = SolverInput::kMovingAi;
  std::string plan = "{output}";  // a template for the file with the paths; empty: there is none
  bool anytime = false;           // it runs until its time limit, which is not a failure
  std::int64_t threads = 1;       // number of threads of the solver
  // Group 1 is a number. `solved` has no group; the expression only has to be found.
  std::optional<LinePattern> solved = {};
  std::optional<LinePattern> cost = {};
  std::optional<LinePattern> lower_bound = {};
  std::optional<LinePattern> seconds = {};
  std::optional<LinePattern> first_plan = {};  // seconds
  std::vector<TracePattern> trace = {};
};

// Reads an adapter from a file or a text. An unknown key is an error. `name` stands for the file of
// a text. Both functions throw InputError.
SolverAdapter read_solver(const std::filesystem::path& path);
SolverAdapter parse_solver(std::string_view text, const std::string& name);

// An error message if `command` does not contain the templates that `input` requires; empty: it
// does.
std::string input_mistake(SolverInput input, const std::vector<std::string>& command);
// True if a template in `command` contains {name}.
bool names(const std::vector<std::string>& command, std::string_view name);

// The words of a command line, separated by blanks outside '...' and "...". Returns nullopt if a
// quote is not closed.
std::optional<std::vector<std::string>> command_words(std::string_view text);

// An error message for an invalid template, for example with an unknown name in braces; empty: it
// is valid.
std::string template_mistake(std::string_view text);
// An error message for an invalid regular expression, or one with fewer than `groups` groups;
// empty: it is valid.
std::string regex_mistake(const std::string& text, std::size_t groups);
// Replaces each name in braces by value(name). Precondition: the template is valid.
template <typename Value>
std::string filled(std::string_view text, const Value& value) {
  std::string result;
  while (!text.empty()) {
    const std::size_t open = text.find('{');
    result += text.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find('}', open);
    result += value(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
  }
  return result;
}

}  // namespace grove::detail
