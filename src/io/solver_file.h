// SPDX-License-Identifier: MIT
// Reads solver adapters, which are files that describe how to run another solver and how to find
// its results (docs/benchmarking.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// The format in which a solver reads an instance, and the placeholders for it in the command.
enum class SolverInput : std::uint8_t {
  kMovingAi,        // {map}, {scenario}, {agents}: classical MAPF
  kBorderedCsv,     // the same, but the map has a border and is a file of 0 and 1: Lazy CBS
  kGrove,           // {instance}, a *.cts.json file: every Grove instance
  kLibmrp,          // {instance}, YAML of libMultiRobotPlanning: classical MAPF
  kPotentialGoals,  // {instance}, the YAML of kLibmrp with one potential goal per agent: ITA-CBS,
                    // CBS-TA
  kMgcbs,           // {instance}, YAML with lists of goals: MG-MAPF
};

// Only the first kMaxLineLength characters of a line are searched for a pattern, because longer
// lines contain paths rather than results, and libstdc++ matches regular expressions by recursion.
inline constexpr std::size_t kMaxLineLength = 4096;

// A pattern for a line with a result. The last line in which the regular expression is found
// counts.
struct LinePattern {
  std::string file;   // template for a file name; empty: the program's standard output
  std::string regex;  // ECMAScript
  double scale = 1;   // factor for the number in group 1, for example 0.001 for milliseconds
};

// What a capture group in the regular expression of a TracePattern contains.
enum class TraceGroup : std::uint8_t {
  kSeconds,
  kMilliseconds,
  kSecondsLeft,  // time left until the time limit
  kCost,
  kLowerBound
};

// A pattern for lines that report intermediate plans. Each line in which the expression is found
// counts.
struct TracePattern {
  LinePattern line;
  std::vector<TraceGroup> groups;  // by group, from group 1; exactly one time, one kCost
};

struct SolverAdapter {
  std::string name;                       // letters, digits and -_.+=
  std::string about = {};                 // description for users
  std::vector<std::string> command = {};  // templates; {program} stands for the program
  SolverInput input = SolverInput::kMovingAi;
  std::string plan = "{output}";  // template for the file with the paths; empty: none
  bool anytime = false;           // the solver runs until its time limit, which is no failure
  std::int64_t threads = 1;       // number of threads of the solver
  // Results. Group 1 of each expression is a number, except in `solved`, whose expression only has
  // to be found.
  std::optional<LinePattern> solved = {};
  std::optional<LinePattern> cost = {};
  std::optional<LinePattern> lower_bound = {};
  std::optional<LinePattern> seconds = {};
  std::optional<LinePattern> first_plan = {};  // time of the first plan, in seconds
  std::vector<TracePattern> trace = {};
};

// Read an adapter from a file, or from its text. `name` is the name of the file in messages. Both
// functions throw InputError for invalid content and for unknown keys.
SolverAdapter read_solver(const std::filesystem::path& path);
SolverAdapter parse_solver(std::string_view text, const std::string& name);

// Returns an error message if `command` lacks a placeholder that `input` requires, or contains
// those of two formats; otherwise "".
std::string input_mistake(SolverInput input, const std::vector<std::string>& command);
// True if a template in `command` contains the placeholder {name}.
bool names(const std::vector<std::string>& command, std::string_view name);

// Splits a command line into words at blanks outside of '...' and "...". Returns nullopt if a quote
// is not closed.
std::optional<std::vector<std::string>> command_words(std::string_view text);

// Returns an error message if the template is invalid, for example because of an unknown
// placeholder; otherwise "".
std::string template_mistake(std::string_view text);
// Returns an error message if the regular expression is invalid or has fewer than `groups` groups;
// otherwise "".
std::string regex_mistake(const std::string& text, std::size_t groups);
// Returns `text` with each placeholder {name} replaced by value(name). Precondition: the template
// is valid.
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
