// SPDX-License-Identifier: MIT
#include "tools/solve/solve_run.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/text_file.h"
#include "tools/common/commands.h"
#include "tools/common/standard_error.h"
#include "tools/common/version.h"
#include "tools/solve/incumbent_files.h"
#include "tools/solve/json_log.h"
#include "tools/solve/plan_output.h"
#include "tools/solve/text_log.h"

namespace grove::detail {
namespace {

constexpr const char* kJsonLines = "jsonl";
// Maximum interval between rows of JSON logs, so that a program sees that the run is alive.
constexpr double kMaxRowInterval_s = 10;

// Returns the method for the log. For an adaptation of CTS-CBS the text includes the policy,
// because only --policy fixed gives the paper's adaptation.
std::string method_text(const SolveArguments& a) {
  const bool is_fixed = solve_options(a).policy == Policy::kFixed;
  if (!is_adaptation(method_of(a))) return a.method;
  return fmt::format("{}, policy {}", a.method,
                     is_fixed ? "fixed" : "free (the paper's: --policy fixed)");
}

// Refuses a prefix of --incumbents with which an incumbent could overwrite another file of the run.
// Removes the incumbents of an earlier run with this prefix.
void prepare_incumbents(const SolveArguments& a, const LoadedInstance& loaded) {
  for (const auto& file : {a.output, a.log, a.proof, a.start, a.instance.path(), loaded.map_path})
    if (IncumbentFiles::matches_name(a.incumbents, file))
      throw InputError(
          file.string(), "",
          fmt::format("could be overwritten by --incumbents {}; expected another prefix",
                      one_line(a.incumbents)));
  IncumbentFiles::remove_old(a.incumbents);
  require_writable(IncumbentFiles::file(a.incumbents, 1));
}

// Returns the name of the plan file if the user has not named one. Throws InputError if a file with
// this name exists and is not a plan file.
std::filesystem::path default_plan_file(const SolveArguments& a) {
  const std::filesystem::path file = a.instance.stem() + ".plan.json";
  if (!std::filesystem::is_regular_file(file)) return file;
  const std::string text = read_text(file);
  for (const std::string_view key : {R"("status")", R"("lower_bound")"})
    if (text.find(key) == std::string::npos)
      throw InputError(file.string(), "",
                       fmt::format("exists and is not a plan file; expected '-o {}' to replace it, "
                                   "or another name",
                                   one_line(file.string())));
  return file;
}

struct PlanWritten {
  std::optional<Cost> kept;  // result of write_plan()
  std::string failure;       // "" if there is none
};

PlanWritten try_to_write_plan(const SolveArguments& a, const Instance& instance,
                              const Solution& solution) {
  try {
    return {write_plan(a.output, instance, solution, a.keeps_cheaper), ""};
  } catch (const InputError& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace

std::vector<OutputLock> prepare_outputs(SolveArguments& a, const LoadedInstance& loaded) {
  if (a.output.empty()) a.output = default_plan_file(a);
  for (const auto& file : {a.output, a.log, a.proof}) {
    require_distinct_files(file, a.instance.path(), "the instance");
    require_distinct_files(file, loaded.map_path, "the map");
  }
  require_distinct_files(a.log, a.start, "the start plan");
  require_distinct_files(a.log, a.output, "the plan file");
  require_distinct_files(a.proof, a.output, "the plan file");
  require_distinct_files(a.proof, a.log, "the log");
  require_distinct_files(a.proof, a.start, "the start plan");
  std::vector<OutputLock> locks;
  for (const auto& file : {a.output, a.log, a.proof})
    if (!file.empty() && file != kStandardOutput) locks.emplace_back(file);
  if (!a.incumbents.empty()) locks.emplace_back(IncumbentFiles::file(a.incumbents, 1));
  if (a.output != kStandardOutput) require_writable(a.output);
  if (!a.incumbents.empty()) prepare_incumbents(a, loaded);
  return locks;
}

std::unique_ptr<LogFormat> open_log(const SolveArguments& a, bool may_show_progress) {
  std::FILE* const screen = a.quiet ? nullptr : a.output == kStandardOutput ? stderr : stdout;
  LogSink sink(screen, a.log, may_show_progress);
  if (a.log_format == kJsonLines) return std::make_unique<JsonLog>(std::move(sink));
  if (a.log_tree > 0) throw CLI::ValidationError("--log-tree", "requires --log-format jsonl");
  return std::make_unique<TextLog>(std::move(sink), a.time_limit_s, a.verbose);
}

RunLog rows_of(LogFormat& log, const SolveArguments& a,
               std::chrono::steady_clock::time_point start) {
  const bool for_programs = a.log_format == kJsonLines;
  RunLog::Options options{.by_work = a.deterministic, .tree_nodes = a.log_tree};
  if (for_programs) options.longest_interval_s = kMaxRowInterval_s;
  return RunLog(log, start, options);
}

LogHead head_of(const CLI::App& app, const SolveArguments& a, const LoadedInstance& loaded,
                const std::string& workers) {
  return {.loaded = loaded,
          .instance = a.instance.name(),
          .options = options_text(app),
          .method = method_of(a) == Method::kAuto ? "" : method_text(a),
          .workers = workers,
          .deterministic = a.deterministic};
}

void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& a,
                   std::chrono::steady_clock::time_point start) {
  solution.stats.measures["wall_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  solution.stats.measures["peak_memory_mb"] = static_cast<double>(peak_resident_bytes()) / 1e6;
  solution.stats.counts["seed"] = a.seed;
  solution.stats.counts["threads"] = a.threads;
  solution.stats.texts["instance"] = a.instance.name();
  solution.stats.texts["options"] = options_text(app);
  solution.stats.texts["method"] = a.method;
  solution.stats.texts["policy"] = solve_options(a).policy == Policy::kFixed ? "fixed" : "free";
  solution.stats.texts["version"] = version_text();
}

std::string finish_run(const SolveArguments& a, const Instance& instance, const Solution& solution,
                       LogFormat& log) {
  const auto [kept, failure] = try_to_write_plan(a, instance, solution);
  log.end({solution, a.output == kStandardOutput ? "standard output" : a.output.string(),
           a.proof.string(), kept, !failure.empty()});
  report_missing_plan(solution, a.output, kept);
  return failure;
}

void report_failures(const std::vector<std::string>& failures) {
  for (const std::string& failure : failures)
    if (!failure.empty()) print_to_stderr("grove: error: " + failure);
  if (std::ranges::any_of(failures, [](const std::string& failure) { return !failure.empty(); }))
    throw CommandFailed(kExitInternalFailure);
}

}  // namespace grove::detail
