// SPDX-License-Identifier: MIT
#include "tools/bench/external_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>

#include "io/format_support.h"
#include "io/input_error.h"
#include "io/libmrp_file.h"
#include "io/map_file.h"
#include "io/plan_import.h"
#include "io/roadmap_file.h"
#include "io/text_file.h"
#include "model/check.h"
#include "model/parse_number.h"
#include "tools/bench/run_outcome.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;

// An anytime solver can end after its time limit by at most max(kGrace_s seconds, kGrace * limit)
// and still count as solved.
constexpr double kGrace_s = 1;
constexpr double kGrace = 0.1;
constexpr std::array<std::string_view, 3> kTimeLimits{"time_limit", "time_limit_ms",
                                                      "time_limit_whole"};

// Returns the content of a file; "" if it does not exist.
std::string text_of(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) ? read_text(path) : std::string();
}

std::string_view beginning(std::string_view line) {
  return line.substr(0, kMaxLineLength);
}

std::optional<double> number_in(const std::string& text) {
  return parse_number<double>(text, -1e18, 1e18);
}

std::optional<Cost> cost_in(std::optional<double> number) {
  if (!number || *number < 0 || *number > 1e15) return std::nullopt;
  return static_cast<Cost>(std::llround(*number));
}

// Returns the trace point that `match` describes. Returns nullopt if it has no valid time or cost.
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

// Sorts the trace by time, keeps only points that improve the cost, and thins them out to
// kMaxTracePoints.
std::vector<batch::TracePoint> improving_points(std::vector<batch::TracePoint> trace) {
  std::ranges::stable_sort(trace, {}, &batch::TracePoint::seconds);
  std::vector<batch::TracePoint> better;
  for (const batch::TracePoint& point : trace)
    if (better.empty() || point.cost < better.back().cost) better.push_back(point);
  thin_out(better, kMaxTracePoints);
  return better;
}

// Replaces agent and task ids that the solver's format cannot express, or that its plan may not
// report, by default ids.
Instance instance_for_solver(const Instance& instance, SolverInput input) {
  if (input == SolverInput::kGrove) return instance;
  Instance renamed = with_default_agent_ids(instance);
  return input == SolverInput::kMgcbs ? with_default_task_ids(renamed) : renamed;
}

// Converts a valid plan to the ids and task numbers of `instance`, which has the same agents.
Solution in_terms_of(const Instance& instance, Solution solution) {
  std::vector<Path> paths;
  for (AgentPlan& agent : solution.plan->agents) paths.push_back(std::move(agent.path));
  solution.plan = plan_of_paths(instance, std::move(paths));
  return solution;
}

// Explains why the run failed; "" if it exited with code 0 within its time limit.
std::string failure_text(const ChildEnd& end, double time_limit_s, const fs::path& output_file) {
  if (end.wall_s > time_limit_s) return kTimeLimit;
  if (end.kind == ChildEnd::Kind::kSignalled)
    return fmt::format("ended by signal {} ({})", end.code, ::strsignal(end.code));
  if (end.code != 0)
    return fmt::format("ended with exit code {}{}", end.code, last_output_line(output_file));
  return "";
}

// Corrects the claimed trace by the re-checked plan of cost `cost`. An anytime solver writes its
// best plan last, so no earlier plan cost less; some solvers report a different measure of cost.
// The trace ends with the re-checked plan at `wall_s`, unless an earlier point has the same cost.
std::vector<batch::TracePoint> corrected_trace(std::vector<batch::TracePoint> trace, Cost cost,
                                               double wall_s) {
  std::erase_if(trace, [&](const batch::TracePoint& point) { return point.seconds > wall_s; });
  for (batch::TracePoint& point : trace) point.cost = std::max(point.cost, cost);
  trace.push_back({.seconds = wall_s, .cost = cost});
  return improving_points(std::move(trace));
}

}  // namespace

ExternalRun::ExternalRun(const ExternalSolver& solver, const batch::Entry& entry,
                         const LoadedInstance& loaded, const batch::Settings& settings,
                         fs::path folder)
    : solver_(solver),
      loaded_(loaded),
      solver_instance_(instance_for_solver(loaded.instance, solver.adapter.input)),
      settings_(settings),
      folder_(fs::absolute(folder)) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  write_input(entry);
}

void ExternalRun::write_input(const batch::Entry& entry) {
  instance_ = entry.path;
  switch (solver_.adapter.input) {
    case SolverInput::kMovingAi:
    case SolverInput::kBorderedCsv:
      return write_map_and_scenario();
    case SolverInput::kGrove:
      if (entry.agents == 0) return;
      instance_ = folder_ / "instance.cts.json";
      return write_instance(instance_, solver_instance_, fs::absolute(entry.map).string());
    case SolverInput::kLibmrp:
      return write_libmrp_instance(instance_ = folder_ / "instance.yaml", solver_instance_);
    case SolverInput::kPotentialGoals:
      return write_potential_goals(instance_ = folder_ / "instance.yaml", solver_instance_);
    case SolverInput::kMgcbs:
      return write_mgcbs_instance(instance_ = folder_ / "instance.yaml", solver_instance_);
  }
}

// Writes a map and a scenario instead of passing the original files, because solvers differ in the
// map characters that they treat as passable and in their use of further scenario rows.
void ExternalRun::write_map_and_scenario() {
  map_ = folder_ / "map.map";
  scenario_ = folder_ / "map.scen";
  write_scenario_instance(scenario_, solver_instance_, "map.map");
  if (solver_.adapter.input == SolverInput::kBorderedCsv)
    return write_bordered_csv(map_, solver_instance_.grid());
  write_map(map_, solver_instance_.grid());
}

std::string ExternalRun::value_of(std::string_view placeholder) const {
  const double limit = settings_.time_limit_s;
  if (placeholder == "program") return solver_.program;
  if (placeholder == "map") return map_.string();
  if (placeholder == "scenario") return scenario_.string();
  if (placeholder == "agents") return std::to_string(solver_instance_.agent_count());
  if (placeholder == "instance") return instance_.string();
  if (placeholder == "time_limit") return fmt::format("{}", limit);
  if (placeholder == "time_limit_ms") return fmt::format("{:.0f}", limit * 1e3);
  if (placeholder == "time_limit_whole") return fmt::format("{:.0f}", std::ceil(limit));
  if (placeholder == "seed") return std::to_string(settings_.seed);
  if (placeholder == "output") return (folder_ / "output").string();
  return folder_.string();
}

std::string ExternalRun::expand(const std::string& text) const {
  return filled(text, [this](std::string_view name) { return value_of(name); });
}

std::vector<std::string> ExternalRun::command() const {
  std::vector<std::string> words = solver_.adapter.command;
  for (std::string& word : words) word = expand(word);
  return words;
}

bool ExternalRun::receives_time_limit() const {
  return std::ranges::any_of(kTimeLimits, [this](std::string_view place) {
    return names(solver_.adapter.command, place);
  });
}

fs::path ExternalRun::plan() const {
  return solver_.adapter.plan.empty() ? fs::path() : fs::path(expand(solver_.adapter.plan));
}

// Returns group 1 of the match in the last matching line; the whole match if the pattern has no
// group. Returns nullopt if no line matches.
std::optional<std::string> ExternalRun::last_match(const LinePattern& pattern,
                                                   const fs::path& output_file) const {
  const std::regex regex(pattern.regex);
  const std::string text =
      text_of(pattern.file.empty() ? output_file : fs::path(expand(pattern.file)));
  std::optional<std::string> found;
  for (const std::string_view line : split_lines(text)) {
    const std::string_view looked_at = beginning(line);
    std::cmatch match;
    if (std::regex_search(looked_at.begin(), looked_at.end(), match, regex))
      found = match.size() > 1 ? match[1].str() : match[0].str();
  }
  return found;
}

std::optional<double> ExternalRun::number_of(const std::optional<LinePattern>& pattern,
                                             const fs::path& output_file) const {
  if (!pattern) return std::nullopt;
  const auto text = last_match(*pattern, output_file);
  const auto number = text ? number_in(*text) : std::nullopt;
  return number && *number >= 0 ? std::optional(*number * pattern->scale) : std::nullopt;
}

void ExternalRun::read_claims(batch::Outcome& outcome, const fs::path& output_file) const {
  const SolverAdapter& adapter = solver_.adapter;
  outcome.claimed_cost = cost_in(number_of(adapter.cost, output_file));
  outcome.claimed_lower_bound = cost_in(number_of(adapter.lower_bound, output_file));
  outcome.claimed_s = number_of(adapter.seconds, output_file);
  outcome.first_plan_s = number_of(adapter.first_plan, output_file);
}

void ExternalRun::read_trace(batch::Outcome& outcome, const fs::path& output_file) const {
  for (const TracePattern& pattern : solver_.adapter.trace) {
    const std::regex regex(pattern.line.regex);
    const std::string text =
        text_of(pattern.line.file.empty() ? output_file : fs::path(expand(pattern.line.file)));
    for (const std::string_view line : split_lines(text)) {
      const std::string words(beginning(line));
      std::smatch match;
      if (!std::regex_search(words, match, regex)) continue;
      if (const auto point = point_in(pattern, match, settings_.time_limit_s))
        outcome.trace.push_back(*point);
    }
  }
  outcome.trace = improving_points(std::move(outcome.trace));
}

void ExternalRun::read_plan(batch::Outcome& outcome, const ChildEnd& end) {
  const fs::path file = plan();
  std::error_code error;
  if (file.empty() || !fs::is_regular_file(file, error)) return;
  try {
    const RecountedPlan recounted = read_and_recount(file, solver_instance_);
    if (!outcome.claimed_cost) outcome.claimed_cost = recounted.claimed_cost;
    if (!outcome.claimed_lower_bound) outcome.claimed_lower_bound = recounted.claimed_lower_bound;
    if (!recounted.solution.plan) return;
    const auto wrong = check(solver_instance_, recounted.solution, 1);
    if (!wrong.empty())
      throw InputError(file.string(), wrong.front().json_pointer, wrong.front().message);
    outcome.cost = recounted.solution.plan->cost;
    outcome.status = to_string(Status::kFeasible);
    const bool same = solver_.adapter.input == SolverInput::kGrove;
    valid_plan_ = same ? recounted.solution : in_terms_of(loaded_.instance, recounted.solution);
  } catch (const InputError& broken) {
    // The solver may have been killed while it wrote the file.
    if (end.kind != ChildEnd::Kind::kExited || end.code != 0) return;
    outcome.status = batch::kInvalidPlan;
    std::string text = broken.what();
    if (text.starts_with(folder_.string())) text.erase(0, folder_.string().size() + 1);
    outcome.error = fmt::format("the plan is wrong: {}", text);
  }
}

// A run of an anytime solver that reached its limit counts as solved if the solver had a plan in
// time. Only the solver itself says when it had the plan, so a run that ends much later than the
// limit does not count.
void ExternalRun::finish_with_plan(batch::Outcome& outcome, const ChildEnd& end,
                                   const fs::path& output_file) const {
  const double limit = settings_.time_limit_s;
  if (!outcome.first_plan_s)
    outcome.first_plan_s = outcome.trace.empty() ? end.wall_s : outcome.trace.front().seconds;
  outcome.trace = corrected_trace(std::move(outcome.trace), *outcome.cost, end.wall_s);
  outcome.error = failure_text(end, limit, output_file);
  if (outcome.anytime && outcome.error == kTimeLimit && *outcome.first_plan_s <= limit) {
    const bool in_time = end.wall_s <= limit + std::max(kGrace_s, kGrace * limit);
    outcome.error =
        in_time
            ? ""
            : fmt::format(
                  "ended {:.1f} s after the time limit; only its own claim says when it had a plan",
                  end.wall_s - limit);
  }
  outcome.solved = outcome.error.empty();
}

void ExternalRun::finish_without_plan(batch::Outcome& outcome, const ChildEnd& end,
                                      const fs::path& output_file) const {
  outcome.trace.clear();
  outcome.first_plan_s.reset();
  outcome.error = failure_text(end, settings_.time_limit_s, output_file);
  if (outcome.claimed_cost ||
      (solver_.adapter.solved && last_match(*solver_.adapter.solved, output_file))) {
    outcome.status = batch::kClaimed;
    outcome.error =
        "claims a plan but wrote none" + (outcome.error.empty() ? "" : "; " + outcome.error);
  } else if (outcome.error.empty()) {
    outcome.error = "ended without a plan" + last_output_line(output_file);
  } else if (outcome.error != kTimeLimit) {
    outcome.status = batch::kError;
  }
}

batch::Outcome ExternalRun::outcome_of_run(const ChildEnd& end, const fs::path& output_file) {
  batch::Outcome outcome;
  outcome.peak_memory_mb = end.peak_memory_mb;
  outcome.anytime = solver_.adapter.anytime;
  if (end.kind == ChildEnd::Kind::kExited && end.code == kCannotBeStarted) {
    outcome.error = fmt::format("cannot be started{}", last_output_line(output_file));
    return outcome;
  }
  outcome.status = to_string(Status::kUnknown);
  read_claims(outcome, output_file);
  read_trace(outcome, output_file);
  read_plan(outcome, end);
  if (outcome.status == batch::kInvalidPlan) {
    outcome.trace.clear();
    outcome.first_plan_s.reset();
  } else if (outcome.cost) {
    finish_with_plan(outcome, end, output_file);
  } else {
    finish_without_plan(outcome, end, output_file);
  }
  return outcome;
}

}  // namespace grove::detail::bench
