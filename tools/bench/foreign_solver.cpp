// SPDX-License-Identifier: MIT
#include "tools/bench/foreign_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>

#include "grove/detail/io/input_error.h"
#include "grove/detail/io/libmrp_file.h"
#include "grove/detail/io/map_file.h"
#include "grove/detail/io/plan_import.h"
#include "grove/detail/io/roadmap_file.h"
#include "grove/detail/io/text_file.h"
#include "grove/detail/model/check.h"
#include "grove/detail/model/parse_number.h"
#include "tools/bench/judge.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kFirstOfShells = 126;  // and above, by convention of shells

// Of a file that may not be there.
std::string text_of(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) ? read_text(path) : std::string();
}

std::optional<double> number_in(const std::string& text) {
  return parse_number<double>(text, -1e18, 1e18);
}

std::optional<Cost> cost_in(std::optional<double> number) {
  if (!number || *number < 0 || *number > 1e15) return std::nullopt;
  return static_cast<Cost>(std::llround(*number));
}

// A point of a trace, if the line says one.
std::optional<batch::TracePoint> point_in(const TracePattern& pattern, const std::smatch& match,
                                          double time_limit_s) {
  batch::TracePoint point;
  for (std::size_t i = 0; i < pattern.groups.size(); ++i) {
    const auto number = number_in(match[i + 1].str());
    switch (pattern.groups[i]) {
      case TraceGroup::kLowerBound:
        point.lower_bound = cost_in(number);
        continue;
      case TraceGroup::kCost:
        if (!cost_in(number)) return std::nullopt;
        point.cost = *cost_in(number);
        continue;
      case TraceGroup::kSeconds:
        point.seconds = number.value_or(-1);
        continue;
      case TraceGroup::kMilliseconds:
        point.seconds = number.value_or(-1e3) / 1e3;
        continue;
      case TraceGroup::kSecondsLeft:
        point.seconds = time_limit_s - number.value_or(time_limit_s + 1);
        continue;
    }
  }
  return point.seconds >= 0 ? std::optional(point) : std::nullopt;
}

std::string why_without_plan(const ChildEnd& end, double time_limit_s, const fs::path& said) {
  switch (end.kind) {
    case ChildEnd::Kind::kExited:
      if (end.code != 0)
        return fmt::format("ended with exit code {}{}", end.code, last_words(said));
      return end.wall_s >= time_limit_s ? "time limit" : "ended without a plan" + last_words(said);
    case ChildEnd::Kind::kSignalled:
      return fmt::format("ended by signal {} ({})", end.code, ::strsignal(end.code));
    case ChildEnd::Kind::kTooLong:
      return "time limit";
    case ChildEnd::Kind::kCancelled:
      return "interrupt";
  }
  return "";
}

}  // namespace

ForeignRun::ForeignRun(const ForeignSolver& solver, const batch::Entry& entry,
                       const LoadedInstance& loaded, const batch::Settings& settings,
                       fs::path folder)
    : solver_(solver), loaded_(loaded), settings_(settings), folder_(std::move(folder)) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  write_input(entry);
}

void ForeignRun::write_input(const batch::Entry& entry) {
  const Instance& instance = loaded_.instance;
  instance_ = entry.path;
  switch (solver_.adapter.input) {
    case SolverInput::kMovingAi:
      if (entry.agents == 0) return write_moving_ai();
      map_ = entry.map;
      scenario_ = entry.path;
      return;
    case SolverInput::kGrove:
      if (entry.agents == 0) return;
      instance_ = folder_ / "instance.cts.json";
      return write_instance(instance_, instance, fs::absolute(entry.map).string());
    case SolverInput::kLibmrp:
      return write_libmrp_instance(instance_ = folder_ / "instance.yaml", instance);
    case SolverInput::kPotentialGoals:
      return write_potential_goals(instance_ = folder_ / "instance.yaml", instance);
    case SolverInput::kMgcbs:
      return write_mgcbs_instance(instance_ = folder_ / "instance.yaml", instance);
  }
}

void ForeignRun::write_moving_ai() {
  map_ = folder_ / "map.map";
  scenario_ = folder_ / "map.scen";
  write_scenario_instance(scenario_, loaded_.instance, "map.map");
  write_map(map_, loaded_.instance.grid());
}

std::string ForeignRun::value_of(std::string_view placeholder) const {
  const double limit = settings_.time_limit_s;
  if (placeholder == "program") return solver_.program;
  if (placeholder == "map") return map_.string();
  if (placeholder == "scenario") return scenario_.string();
  if (placeholder == "agents") return std::to_string(loaded_.instance.agent_count());
  if (placeholder == "instance") return instance_.string();
  if (placeholder == "time_limit") return fmt::format("{}", limit);
  if (placeholder == "time_limit_ms") return fmt::format("{:.0f}", limit * 1e3);
  if (placeholder == "time_limit_whole") return fmt::format("{:.0f}", std::ceil(limit));
  if (placeholder == "seed") return std::to_string(settings_.seed);
  if (placeholder == "output") return (folder_ / "output").string();
  return folder_.string();
}

std::string ForeignRun::told(const std::string& text) const {
  return filled(text, [this](std::string_view name) { return value_of(name); });
}

std::vector<std::string> ForeignRun::command() const {
  std::vector<std::string> words = *command_words(solver_.adapter.command);
  words.insert(words.end(), solver_.more.begin(), solver_.more.end());
  for (std::string& word : words) word = told(word);
  return words;
}

fs::path ForeignRun::plan() const {
  return solver_.adapter.plan.empty() ? fs::path() : fs::path(told(solver_.adapter.plan));
}

// Group 1 of the last line in which the pattern is found; the whole match if it has none.
std::optional<std::string> ForeignRun::last_match(const LinePattern& pattern,
                                                  const fs::path& said) const {
  const std::regex regex(pattern.regex);
  const std::string text =
      text_of(pattern.file.empty() ? said : fs::path(told(pattern.file)));
  std::optional<std::string> found;
  for (const std::string_view line : split_lines(text)) {
    std::cmatch match;
    if (std::regex_search(line.data(), line.data() + line.size(), match, regex))
      found = match.size() > 1 ? match[1].str() : match[0].str();
  }
  return found;
}

std::optional<double> ForeignRun::number_of(const std::optional<LinePattern>& pattern,
                                            const fs::path& said) const {
  if (!pattern) return std::nullopt;
  const auto text = last_match(*pattern, said);
  const auto number = text ? number_in(*text) : std::nullopt;
  return number && *number >= 0 ? std::optional(*number * pattern->scale) : std::nullopt;
}

void ForeignRun::read_claims(batch::Outcome& outcome, const fs::path& said) const {
  const SolverAdapter& adapter = solver_.adapter;
  outcome.claimed_cost = cost_in(number_of(adapter.cost, said));
  outcome.claimed_lower_bound = cost_in(number_of(adapter.lower_bound, said));
  outcome.claimed_s = number_of(adapter.seconds, said);
  outcome.first_plan_s = number_of(adapter.first_plan, said);
}

// Costs fall: what is no better is no news.
void ForeignRun::read_trace(batch::Outcome& outcome, const fs::path& said) const {
  for (const TracePattern& pattern : solver_.adapter.trace) {
    const std::regex regex(pattern.line.regex);
    const std::string text =
        text_of(pattern.line.file.empty() ? said : fs::path(told(pattern.line.file)));
    for (const std::string_view line : split_lines(text)) {
      const std::string words(line);
      std::smatch match;
      if (!std::regex_search(words, match, regex)) continue;
      if (const auto point = point_in(pattern, match, settings_.time_limit_s))
        outcome.trace.push_back(*point);
    }
  }
  std::ranges::stable_sort(outcome.trace, {}, &batch::TracePoint::seconds);
  std::vector<batch::TracePoint> better;
  for (const batch::TracePoint& point : outcome.trace)
    if (better.empty() || point.cost < better.back().cost) better.push_back(point);
  thin_out(better, kMostTracePoints);
  outcome.trace = std::move(better);
}

void ForeignRun::read_plan(batch::Outcome& outcome) const {
  const fs::path file = plan();
  std::error_code error;
  if (file.empty() || !fs::is_regular_file(file, error)) return;
  try {
    const RecountedPlan told = read_and_recount(file, loaded_.instance);
    if (!outcome.claimed_cost) outcome.claimed_cost = told.claimed_cost;
    if (!outcome.claimed_lower_bound) outcome.claimed_lower_bound = told.claimed_lower_bound;
    if (!told.solution.plan) return;
    const auto wrong = check(loaded_.instance, told.solution, 1);
    if (!wrong.empty()) throw InputError("", wrong.front().place, wrong.front().message);
    outcome.cost = told.solution.plan->cost;
    outcome.status = to_string(told.solution.status);
  } catch (const InputError& broken) {
    outcome.status = batch::kWrongPlan;
    outcome.error = fmt::format("the plan is wrong: {}", broken.what());
  }
}

batch::Outcome ForeignRun::judged(const ChildEnd& end, const fs::path& said) const {
  batch::Outcome outcome;
  outcome.anytime = solver_.adapter.anytime;
  if (end.kind == ChildEnd::Kind::kExited && end.code >= kFirstOfShells) {
    outcome.error = fmt::format("cannot be started: exit code {}{}", end.code, last_words(said));
    return outcome;
  }
  outcome.status = to_string(Status::kUnknown);
  read_claims(outcome, said);
  read_trace(outcome, said);
  read_plan(outcome);
  if (!outcome.first_plan_s && !outcome.trace.empty())
    outcome.first_plan_s = outcome.trace.front().seconds;
  if (outcome.status == batch::kWrongPlan) return outcome;
  const double limit = settings_.time_limit_s;
  if (outcome.cost) {
    const bool ended = end.kind == ChildEnd::Kind::kExited && end.code == 0;
    outcome.solved = outcome.anytime ? outcome.first_plan_s.value_or(0) <= limit
                                     : ended && end.wall_s <= limit;
    if (!outcome.solved) outcome.error = why_without_plan(end, 0, said);
    return outcome;
  }
  const bool claims_plan = outcome.claimed_cost ||
                           (solver_.adapter.solved && last_match(*solver_.adapter.solved, said));
  if (claims_plan) {
    outcome.status = batch::kClaimed;
    outcome.error = "claims a plan, and shows none";
  } else {
    outcome.error = why_without_plan(end, limit, said);
  }
  return outcome;
}

}  // namespace grove::detail::bench
