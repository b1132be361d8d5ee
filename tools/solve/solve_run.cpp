// SPDX-License-Identifier: MIT
#include "tools/solve/solve_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "grove/io/atomic_file.h"
#include "grove/io/input_error.h"
#include "tools/common/machine.h"
#include "tools/common/version.h"
#include "tools/solve/incumbent_files.h"

namespace grove {
namespace {

std::string count_text(int count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string agents_text(const Instance& instance) {
  const auto free_ends =
      std::ranges::count_if(instance.agents(), [](const Agent& agent) { return !agent.goal; });
  return count_text(instance.agent_count(), "agent") +
         (free_ends == 0 ? "" : fmt::format(" ({} without a goal)", free_ends));
}

// FILE.cts.json: FILE.plan.json; the first 20 rows of FILE.scen: FILE-20.plan.json.
std::filesystem::path default_output(const InstanceArguments& instance, int agents) {
  std::string name = std::filesystem::path(instance.path()).filename().string();
  const bool is_scenario = name.ends_with(".scen");
  for (const std::string_view suffix : {".cts.json", ".json", ".scen"})
    if (name.ends_with(suffix)) {
      name.resize(name.size() - suffix.size());
      break;
    }
  return name + (is_scenario ? fmt::format("-{}", agents) : "") + ".plan.json";
}

// An adaptation of CTS-CBS is the paper's with the paper's policy.
std::string method_text(const SolveArguments& a) {
  const bool is_fixed = solve_options(a).policy == Policy::kFixed;
  if (!is_adaptation(method_of(a))) return a.method;
  return fmt::format("{}, policy {}", a.method,
                     is_fixed ? "fixed" : "free (the paper's: --policy fixed)");
}

// The files of --incumbents must not replace any other of the run.
void prepare_incumbents(const SolveArguments& a, const LoadedInstance& loaded) {
  const std::filesystem::path instance = a.instance.path();
  for (const auto& file : {a.output, a.log, a.start, instance, loaded.map_path})
    if (IncumbentFiles::may_be_file(a.incumbents, file))
      throw InputError(file.string(), "",
                       fmt::format("--incumbents {} may write over it; expected another prefix",
                                   one_line(a.incumbents)));
  IncumbentFiles::remove_old(a.incumbents);
  require_writable(IncumbentFiles::file(a.incumbents, 1));
}

}  // namespace

void prepare_outputs(SolveArguments& a, const LoadedInstance& loaded) {
  if (a.output.empty()) a.output = default_output(a.instance, loaded.instance.agent_count());
  for (const auto& file : {a.output, a.log}) {
    require_distinct_files(file, a.instance.path(), "the instance");
    require_distinct_files(file, loaded.map_path, "the map");
  }
  require_distinct_files(a.log, a.start, "the start plan");
  require_distinct_files(a.log, a.output, "the plan file");
  require_writable(a.output);
  if (!a.incumbents.empty()) prepare_incumbents(a, loaded);
}

void log_head(LogSink& sink, const CLI::App& app, const SolveArguments& a,
              const LoadedInstance& loaded, const std::string& workers) {
  const Instance& instance = loaded.instance;
  const std::string options = options_text(app);
  sink.line(fmt::format("{} on {}", version_text(), machine_text()));
  sink.line(fmt::format("Instance      {}: {}, {}", a.instance.path(), agents_text(instance),
                        count_text(instance.task_count(), "task")));
  sink.line(fmt::format("Map           {}: {} x {}, {} passable cells", loaded.map_path.string(),
                        instance.grid().width(), instance.grid().height(),
                        instance.grid().passable_count()));
  sink.line(fmt::format("Options       {}", options.empty() ? "all defaults" : options));
  if (method_of(a) != Method::kAuto) sink.line(fmt::format("Method        {}", method_text(a)));
  sink.line(fmt::format("Threads       {}{}", workers, a.deterministic ? ", deterministic" : ""));
  sink.line();
  sink.line(
      "First column: a better plan (* from the tree, H by priorities, C by configuration search,");
  sink.line(
      "L by large neighbourhood search, S given), else a higher bound (B), else a new tree (T).");
  sink.line(
      "expanded, open: nodes of the search tree done and waiting. No plan costs less than the "
      "lower");
  sink.line("bound; incumbent is the cost of the best plan so far.");
  sink.line("gap = (incumbent - lower bound) / lower bound, so it compares with omega directly.");
  sink.line();
}

void log_resumed(LogSink& sink, const CheckpointHeader& checkpoint) {
  const auto expanded = checkpoint.counters.find("nodes_expanded");
  sink.line(fmt::format(
      "Resuming from a checkpoint after {:.1f} s and {} nodes: lower bound {}{}",
      checkpoint.seconds, expanded == checkpoint.counters.end() ? 0 : expanded->second,
      checkpoint.lower_bound,
      checkpoint.incumbent ? fmt::format(", incumbent {}", checkpoint.incumbent->cost) : ""));
  sink.line();
}

void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& a,
                   std::chrono::steady_clock::time_point start) {
  solution.stats.measures["wall_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  solution.stats.measures["peak_memory_mb"] = static_cast<double>(peak_resident_bytes()) / 1e6;
  solution.stats.counts["seed"] = a.seed;
  solution.stats.counts["threads"] = a.threads;
  solution.stats.texts["instance"] = a.instance.path();
  solution.stats.texts["options"] = options_text(app);
  solution.stats.texts["method"] = a.method;
  solution.stats.texts["policy"] = solve_options(a).policy == Policy::kFixed ? "fixed" : "free";
  solution.stats.texts["version"] = version_text();
}

}  // namespace grove
