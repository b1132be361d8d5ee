// SPDX-License-Identifier: MIT
#include "io/solver_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>

#include "io/input_error.h"
#include "io/json_value.h"
#include "io/known_keys.h"

namespace grove::detail {
namespace {

constexpr std::array<std::string_view, 11> kPlaceholders{
    "program",          "map",  "scenario", "agents", "instance", "time_limit", "time_limit_ms",
    "time_limit_whole", "seed", "output",   "folder"};

struct NamedInput {
  std::string_view name;
  SolverInput input;
};
constexpr std::array<NamedInput, 6> kInputs{{{"movingai", SolverInput::kMovingAi},
                                             {"bordered-csv", SolverInput::kBorderedCsv},
                                             {"grove", SolverInput::kGrove},
                                             {"libmrp", SolverInput::kLibmrp},
                                             {"potential-goals", SolverInput::kPotentialGoals},
                                             {"mgcbs", SolverInput::kMgcbs}}};

struct NamedGroup {
  std::string_view name;
  TraceGroup group;
};
constexpr std::array<NamedGroup, 5> kGroups{{{"seconds", TraceGroup::kSeconds},
                                             {"milliseconds", TraceGroup::kMilliseconds},
                                             {"seconds_left", TraceGroup::kSecondsLeft},
                                             {"cost", TraceGroup::kCost},
                                             {"lower_bound", TraceGroup::kLowerBound}}};

template <typename Names>
std::string listed_names(const Names& names) {
  std::string text;
  for (const auto& each : names) text += fmt::format("{}{}", text.empty() ? "" : ", ", each.name);
  return text;
}

template <typename Names>
auto one_of_names(const JsonValue& value, const Names& names) {
  const std::string text = value.text();
  const auto it = std::ranges::find(names, text, [](const auto& each) { return each.name; });
  if (it == names.end()) value.fail_expected("one of " + listed_names(names));
  return *it;
}

std::string template_of(const JsonValue& value) {
  std::string text = value.text();
  const std::string mistake = template_mistake(text);
  if (!mistake.empty()) value.fail(mistake);
  return text;
}

// Reads a pattern, written as "REGEX" or as {"file": ..., "regex": ...}. The object may have
// further keys.
LinePattern pattern_of(const JsonValue& value, std::size_t groups) {
  LinePattern pattern;
  JsonValue regex = value;
  if (value.json().is_object()) {
    if (const auto file = value.find("file")) pattern.file = template_of(*file);
    regex = value.member("regex");
  }
  pattern.regex = regex.text();
  const std::string mistake = regex_mistake(pattern.regex, groups);
  if (!mistake.empty()) regex.fail(mistake);
  return pattern;
}

double scale_of(const JsonValue& unit) {
  const std::string text = unit.text();
  if (text != "s" && text != "ms") unit.fail_expected("s or ms");
  return text == "ms" ? 1e-3 : 1;
}

std::optional<LinePattern> claim_of(const JsonValue& claims, const char* key, std::size_t groups) {
  const auto value = claims.find(key);
  if (!value) return std::nullopt;
  if (!value->json().is_object()) return pattern_of(*value, groups);
  LinePattern pattern = pattern_of(*value, groups);
  if (const auto unit = value->find("unit")) pattern.scale = scale_of(*unit);
  return pattern;
}

TracePattern trace_of(const JsonValue& value) {
  const JsonValue groups = value.member("groups");
  TracePattern trace;
  for (std::size_t i = 0; i < groups.size(); ++i)
    trace.groups.push_back(one_of_names(groups.element(i), kGroups).group);
  const auto times = std::ranges::count_if(trace.groups, [](TraceGroup group) {
    return group != TraceGroup::kCost && group != TraceGroup::kLowerBound;
  });
  if (times != 1 || std::ranges::count(trace.groups, TraceGroup::kCost) != 1)
    groups.fail("expected cost once and exactly one time: seconds, milliseconds or seconds_left");
  trace.line = pattern_of(value, trace.groups.size());
  return trace;
}

std::vector<std::string> command_of(const JsonValue& value, SolverInput input) {
  const auto words = command_words(template_of(value));
  if (!words) value.fail("a quote is not closed");
  if (!names(*words, "program")) value.fail("expected {program} as the program");
  if (const std::string mistake = input_mistake(input, *words); !mistake.empty())
    value.fail(mistake);
  return *words;
}

bool is_plain_name(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("-_.+=").find(c) != std::string_view::npos;
  };
  return !name.empty() && std::ranges::all_of(name, is_plain);
}

SolverAdapter solver_of(const JsonValue& root) {
  require_known_keys(root, solver_keys());
  SolverAdapter solver;
  const JsonValue name = root.member("name");
  solver.name = name.text();
  if (!is_plain_name(solver.name))
    name.fail_expected("a name of letters, digits and -_.+= without blanks");
  if (const auto about = root.find("about")) solver.about = about->text();
  if (const auto input = root.find("instance")) solver.input = one_of_names(*input, kInputs).input;
  solver.command = command_of(root.member("command"), solver.input);
  if (const auto plan = root.find("plan"))
    solver.plan = plan->json().is_null() ? "" : template_of(*plan);
  if (const auto anytime = root.find("anytime")) solver.anytime = anytime->boolean();
  if (const auto threads = root.find("threads")) solver.threads = threads->integer(1, 1024);
  if (const auto claims = root.find("claims")) {
    solver.solved = claim_of(*claims, "solved", 0);
    solver.cost = claim_of(*claims, "cost", 1);
    solver.lower_bound = claim_of(*claims, "lower_bound", 1);
    solver.seconds = claim_of(*claims, "seconds", 1);
    solver.first_plan = claim_of(*claims, "first_plan", 1);
  }
  if (const auto trace = root.find("trace"))
    for (std::size_t i = 0; i < trace->size(); ++i)
      solver.trace.push_back(trace_of(trace->element(i)));
  if (solver.plan.empty() && !solver.cost && !solver.solved)
    root.fail("found neither a plan nor claims; expected one of plan, claims");
  return solver;
}

}  // namespace

SolverAdapter read_solver(const std::filesystem::path& path) {
  const JsonDocument document(path);
  return solver_of(document.root());
}

SolverAdapter parse_solver(std::string_view text, const std::string& name) {
  const JsonDocument document(text, name);
  return solver_of(document.root());
}

std::optional<std::vector<std::string>> command_words(std::string_view text) {
  std::vector<std::string> words;
  bool within_word = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == ' ' || c == '\t' || c == '\n') {
      within_word = false;
      continue;
    }
    if (!within_word) words.emplace_back();
    within_word = true;
    if (c != '\'' && c != '"') {
      words.back() += c;
      continue;
    }
    const std::size_t end = text.find(c, i + 1);
    if (end == std::string_view::npos) return std::nullopt;
    words.back() += text.substr(i + 1, end - i - 1);
    i = end;
  }
  return words;
}

bool names(const std::vector<std::string>& command, std::string_view name) {
  const std::string place = fmt::format("{{{}}}", name);
  return std::ranges::any_of(
      command, [&](const std::string& word) { return word.find(place) != std::string::npos; });
}

std::string input_mistake(SolverInput input, const std::vector<std::string>& command) {
  const bool has_map = names(command, "map") || names(command, "scenario");
  const bool has_instance = names(command, "instance");
  if (has_map && has_instance) return "expected {instance}, or {map} and {scenario}, and not both";
  if (input == SolverInput::kMovingAi || input == SolverInput::kBorderedCsv)
    return names(command, "map") && names(command, "scenario") ? ""
                                                               : "expected {map} and {scenario}";
  return has_instance ? "" : "expected {instance}";
}

std::string regex_mistake(const std::string& text, std::size_t groups) {
  try {
    const std::size_t found = std::regex(text).mark_count();
    if (found >= groups) return "";
    return fmt::format("found {} group{} in round brackets; expected {}", found,
                       found == 1 ? "" : "s", groups);
  } catch (const std::regex_error& error) {
    return fmt::format("found '{}', which is not a regular expression (ECMAScript): {}",
                       one_line(text), error.what());
  }
}

std::string template_mistake(std::string_view text) {
  while (true) {
    const std::size_t brace = text.find_first_of("{}");
    if (brace == std::string_view::npos) return "";
    const std::size_t close = text.find('}', brace);
    if (text[brace] == '}' || close == std::string_view::npos)
      return "found an unpaired brace; expected names in braces, such as {map}";
    const std::string_view name = text.substr(brace + 1, close - brace - 1);
    if (std::ranges::find(kPlaceholders, name) == kPlaceholders.end())
      return fmt::format("found {{{}}}; expected one of {{{}}}", one_line(name),
                         fmt::join(kPlaceholders, "}, {"));
    text.remove_prefix(close + 1);
  }
}

}  // namespace grove::detail
