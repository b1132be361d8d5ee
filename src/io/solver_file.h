// SPDX-License-Identifier: MIT
// How a program of someone else is called, and what it leaves behind to read: adapters, as files
// (docs/benchmarking.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grove::detail {

// The form in which a solver gets an instance.
enum class SolverInput : std::uint8_t {
  kMovingAi,        // {map}, {scenario}, {agents}: classical MAPF
  kGrove,           // {instance}, a *.cts.json: whatever Grove can say
  kLibmrp,          // {instance}, YAML of libMultiRobotPlanning: classical MAPF
  kPotentialGoals,  // {instance}, the same with one potential goal each: ITA-CBS, CBS-TA
  kMgcbs,           // {instance}, YAML with lists of goals: MG-MAPF
};

// A line of text that tells something: the last one in which the expression is found. (Of lines
// longer than kLongestLine their beginning: a path is no claim, and libstdc++ recurses.)
inline constexpr std::size_t kLongestLine = 4096;
struct LinePattern {
  std::string file;   // a template; empty: what the program printed
  std::string regex;  // ECMAScript
  double scale = 1;   // of the number that group 1 is: 0.001 of milliseconds
};

// What group k of an expression, from 1, tells of a plan.
enum class TraceGroup : std::uint8_t {
  kSeconds,
  kMilliseconds,
  kSecondsLeft,  // of the time limit
  kCost,
  kLowerBound
};

// Every line in which the expression is found is a plan found on the way.
struct TracePattern {
  LinePattern line;
  std::vector<TraceGroup> groups;  // one of them a time, one the cost
};

struct SolverAdapter {
  std::string name;                       // letters, digits and -_.+=
  std::string about = {};                 // for people
  std::vector<std::string> command = {};  // templates; {program} is the program
  SolverInput input = SolverInput::kMovingAi;
  std::string plan = "{output}";  // a template: the file with its paths; empty: it writes none
  bool anytime = false;           // it goes on until its time limit: that is no failure
  std::int64_t threads = 1;       // that it runs
  // Group 1 is a number; of `solved` nothing but that it is found.
  std::optional<LinePattern> solved = {};
  std::optional<LinePattern> cost = {};
  std::optional<LinePattern> lower_bound = {};
  std::optional<LinePattern> seconds = {};
  std::optional<LinePattern> first_plan = {};  // seconds
  std::vector<TracePattern> trace = {};
};

// One adapter a file, strictly: an unknown key is an error too. `name` stands for the file of a
// text. Throw InputError.
SolverAdapter read_solver(const std::filesystem::path& path);
SolverAdapter parse_solver(std::string_view text, const std::string& name);

// What such a command must name to be told the instance. A complaint; empty: it does.
std::string input_mistake(SolverInput input, const std::vector<std::string>& command);
// Whether a template of `command` holds {name}.
bool names(const std::vector<std::string>& command, std::string_view name);

// A command line as words: blanks part them but within '...' or "...". None: a quote is not closed.
std::optional<std::vector<std::string>> command_words(std::string_view text);

// What is wrong with a template, an unknown name in braces say, as a complaint; empty: nothing.
std::string template_mistake(std::string_view text);
// What is wrong with a regular expression, or that it has fewer groups than that; likewise.
std::string regex_mistake(const std::string& text, std::size_t groups);
// A template without mistakes, its names in braces replaced by what `value` says of each.
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
