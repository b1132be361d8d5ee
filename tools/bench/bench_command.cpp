// SPDX-License-Identifier: MIT
// grove bench: runs methods on instances and tabulates the results.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "batch/manifest.h"
#include "batch/result_table.h"
#include "batch/scenario_sweep.h"
#include "io/input_error.h"
#include "tools/bench/bench_methods.h"
#include "tools/bench/bench_run.h"
#include "tools/bench/method_support.h"
#include "tools/common/commands.h"
#include "tools/common/helper_program.h"
#include "tools/common/instance_arguments.h"
#include "tools/common/machine.h"
#include "tools/common/options.h"
#include "tools/common/progress_style.h"
#include "tools/common/signals.h"
#include "tools/common/standard_error.h"
#include "tools/common/version.h"

namespace grove::detail {
namespace {

constexpr double kMemoryShare = 0.8;
constexpr double kMinMemory_gb = 0.1;
constexpr const char* kAll = "*";

constexpr const char* kBenchFooter =
    R"(INSTANCES is one of:
- a list of instances, as 'grove generate paper' writes it: on each line a path relative to the
  list, or FILE.scen --map M --agents K; # begins a comment
- a folder: all *.cts.json below it
- Moving AI scenarios, a folder or one file, with --agents 10:100:10 or 10,20,50: an instance for
  each number, of that many first rows of each scenario

A run is 'NAME: OPTIONS OF grove solve'; NAME alone is short for 'NAME: --method NAME'. Each run is
a process of its own, with one thread and omega 0.01 unless its options set other values. All
methods run on one instance before the next one starts, and the first scenario (_s1_ in its name)
of every kind comes before any second one, so that the results are balanced at any moment.

When a run has ended and its plan was re-checked, it gets a row in DIR/results.jsonl, from which
DIR/results.csv is made. The same command resumes a benchmark that was stopped by Ctrl-C or killed,
or that now has more runs, seeds or instances. Runs that ended in an error are repeated. Existing
rows of the same names with other options, limits or instances are an error.

A run counts as solved if it ended with a plan before any limit. A run that reached its limit is
not solved, even with a plan. So this rates methods that improve their plan until the limit
(cts-cbs-c --anytime) below their worth. Exits with 130 if it was stopped before all runs were done.

--solver adds an external solver, by an adapter: eecbs, cbsh2-rtc, lazy-cbs, mapf-lns2, lacam3,
mgcbs, ita-cbs2, or one of your own (docs/benchmarking.md). Options after the program are added to
those of the adapter, or replace them. Plans are re-checked and their costs recomputed. An invalid
plan is "wrong", a plan that the solver only reports is "claimed", and a claim of any method that a
result of another one disproves is "refuted" at the end. A solver that always runs until its limit,
according to its adapter, has solved an instance if it has a plan in time.

Examples:
  grove bench movingai/ --agents 10:50:10 --scenarios 'random-32-32-20-random-*' \
        --run 'grove: --omega 0' --solver 'eecbs=/opt/eecbs --suboptimality 1.05' \
        --time-limit 30 --output-dir results
  grove bench paper/manifest.txt --run 'paper: --policy fixed' --run 'grove:' --output-dir results
  grove bench instances/ --run 'exact: --omega 0' --run 'near: --omega 0.1' --time-limit 60 \
        --jobs 4 --output-dir results)";

struct BenchArguments {
  std::string instances;
  std::vector<std::string> runs;
  std::vector<std::string> solvers;
  std::vector<std::string> claims;
  std::vector<std::int64_t> agents;
  std::string scenarios = kAll;
  std::vector<std::int64_t> seeds;
  std::string output_dir;
  RunDefaults defaults;
  double memory_limit_gb = 0;
  std::int64_t jobs = 0;  // 0: usable cores divided by threads per run
  bool keep_plans = false;
  bool certify = false;
  bool confined = false;
  bool quiet = false;
};

int jobs_of(const BenchArguments& a, const std::vector<bench::Method>& methods) {
  if (a.jobs > 0) return static_cast<int>(a.jobs);
  const auto threads = std::ranges::max(methods, {}, &bench::Method::threads).threads;
  return static_cast<int>(std::max<std::int64_t>(1, usable_cores() / threads));
}

// Gives each run without a memory limit an equal share of the machine's memory. The share is not
// recorded as a limit in the table, because results normally do not depend on it.
void share_memory(std::vector<bench::Method>& methods, int jobs) {
  const double share =
      std::max(kMinMemory_gb, std::floor(10 * kMemoryShare * usable_memory_gb() / jobs) / 10);
  for (bench::Method& method : methods) {
    if (method.settings.memory_limit_gb) continue;
    if (method.solver)
      method.memory_gb = share;
    else
      method.arguments.insert(method.arguments.end(), {"--memory-limit", fmt::format("{}", share)});
  }
}

std::vector<bench::Method> solvers_of(const BenchArguments& a) {
  std::vector<bench::Method> methods;
  for (bench::NamedSolver& solver : bench::read_solver_arguments(a.solvers, a.claims))
    methods.push_back(
        {.settings = {.method = solver.name,
                      .options = solver.options,
                      .omega = "",
                      .seed = a.defaults.seed,
                      .time_limit_s = a.defaults.time_limit_s,
                      .memory_limit_gb = a.defaults.memory_limit_gb},
         .threads = solver.solver.adapter.threads,
         .memory_gb = a.defaults.memory_limit_gb,
         .solver = std::make_shared<bench::ExternalSolver>(std::move(solver.solver))});
  return methods;
}

void require_distinct_names(const std::vector<bench::Method>& methods) {
  std::set<std::string> names;
  for (const bench::Method& method : methods)
    if (!names.insert(method.settings.method).second)
      throw CLI::ValidationError(
          "--solver",
          fmt::format("found a second '{}'; expected distinct names", method.settings.method));
}

// Returns every combination of a method and a seed.
std::vector<bench::Method> with_seeds(const std::vector<bench::Method>& methods,
                                      const std::vector<std::int64_t>& seeds) {
  std::vector<bench::Method> all;
  for (const std::int64_t seed : seeds)
    for (bench::Method method : methods) {
      method.settings.seed = seed;
      const auto given = std::ranges::find(method.arguments, "--seed");
      if (given != method.arguments.end()) *(given + 1) = std::to_string(seed);
      all.push_back(std::move(method));
    }
  return all;
}

std::vector<bench::Method> methods_of(BenchArguments& a) {
  std::vector<bench::Method> methods = read_runs(a.runs, a.defaults);
  std::ranges::move(solvers_of(a), std::back_inserter(methods));
  if (methods.empty()) throw CLI::RequiredError("--run or --solver");
  require_distinct_names(methods);
  for (const std::string& run : a.runs)
    if (!a.seeds.empty() && run.find("--seed") != std::string::npos)
      throw CLI::ValidationError("--seeds", "found --seed in a run; expected only one of them");
  return methods;
}

std::vector<batch::Entry> entries_of(const BenchArguments& a) {
  const InputRules rules = input_rules(a.confined, default_memory_gb());
  if (a.agents.empty()) {
    if (a.scenarios != kAll) throw CLI::ValidationError("--scenarios", "requires --agents");
    if (batch::holds_scenarios(a.instances))
      throw CLI::ValidationError("--agents",
                                 "required with scenarios; expected numbers of rows, such as "
                                 "10:100:10 or 10,20,50");
    return batch::read_manifest(a.instances, rules);
  }
  const std::vector<int> agents(a.agents.begin(), a.agents.end());
  batch::SweptScenarios swept =
      batch::read_scenarios(a.instances, {.agents = agents, .scenarios = a.scenarios}, rules);
  if (swept.too_short > 0)
    print_to_stderr(
        fmt::format("grove: warning: {} scenario{} fewer rows than the maximum of --agents; "
                    "instances with more agents than rows are left out",
                    swept.too_short, swept.too_short == 1 ? " has" : "s have"));
  return std::move(swept.entries);
}

void warn_of_unreadable(const std::vector<bench::BenchInstance>& instances) {
  for (const bench::BenchInstance& instance : instances)
    if (!instance.error.empty())
      print_to_stderr(
          fmt::format("grove: warning: {}; its rows have an error", one_line(instance.error)));
}

void run(const CLI::App& app, BenchArguments& a) {
  if (app.count("--memory-limit") > 0) a.defaults.memory_limit_gb = a.memory_limit_gb;
  std::vector<bench::Method> methods = methods_of(a);
  const int jobs = jobs_of(a, methods);
  share_memory(methods, jobs);
  const auto instances = bench::balanced(entries_of(a));
  warn_of_unreadable(instances);

  stop_on_signals();
  batch::ProgressDisplay display(stderr_style());
  bench::BenchOptions options;
  options.program = "/proc/self/exe";  // this program, even if the file has been replaced
  options.folder = a.output_dir;
  options.jobs = jobs;
  options.keep_plans = a.keep_plans;
  if (a.certify) options.verify = program_beside("grove-verify");
  options.version = version_text();
  options.machine = processor_text();
  options.stopped = [] { return interrupted.load(); };
  options.watch = [&](const bench::BenchState& state) {
    if (!a.quiet && display.is_due(state.elapsed_s))
      display.show(state.elapsed_s, progress_text(state));
  };
  check_method_support(instances, methods, options);
  if (!a.seeds.empty()) methods = with_seeds(methods, a.seeds);
  const bench::BenchState state = run_bench(instances, methods, options);
  if (!a.quiet) display.finish(progress_text(state));
  for (const std::string& version : state.other_versions)
    print_to_stderr(
        fmt::format("grove: warning: {} has rows of {}; they are kept", a.output_dir, version));
  if (state.work.left > 0)
    print_to_stderr(fmt::format("grove: stopped with {} run{} left; repeat the command to resume",
                                state.work.left, state.work.left == 1 ? "" : "s"));
  fmt::print("{}table: {}\n", summary_table(state), batch::csv_file(a.output_dir).string());
  if (state.work.left > 0) throw CommandFailed(kExitInterrupted);
}

}  // namespace

void add_bench_command(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("bench", "Run methods on many instances and tabulate the results");
  app->footer(kBenchFooter);
  const auto a = std::make_shared<BenchArguments>();
  app->add_option("INSTANCES", a->instances,
                  "list or folder of instances, one instance, or scenarios; see below")
      ->required()
      ->type_name("");
  add_repeated(*app, "--run", a->runs, "'NAME: OPTIONS'",
               "method: a name and options of grove solve (repeatable)");
  add_repeated(
      *app, "--solver", a->solvers, "'NAME=COMMAND'",
      "external solver (repeatable): eecbs=PROGRAM OPTIONS, with the adapter of that name; "
      "NAME=ADAPTER:PROGRAM OPTIONS; or NAME=COMMAND with placeholders such as {map}, "
      "{scenario}, "
      "{agents}, {instance}, {time_limit}, {seed}, {output}");
  add_repeated(
      *app, "--claimed-cost", a->claims, "'NAME=REGEX'",
      "where solver NAME, which writes no plan, prints the cost that it claims: group 1 of "
      "REGEX in the last line that matches");
  add_confine_option(*app, a->confined);
  add_counts(
      *app, "--agents", a->agents,
      "numbers of agents, for scenarios: that many first rows; 10:100:10 is 10, 20, ..., 100");
  app->add_option("--scenarios", a->scenarios,
                  "use only these scenarios of the folder; * matches any characters")
      ->type_name("NAME*");
  add_ranges(*app, "--seeds", a->seeds, kSeeds, "", "repeat each run with each of these seeds");
  app->add_option("--output-dir", a->output_dir, "folder for the table; created if missing")
      ->required()
      ->type_name("DIR");
  add_number(*app, "--time-limit", a->defaults.time_limit_s, 0, 1e9,
             "time limit of a run whose options set none, seconds")
      ->type_name("S");
  add_number(*app, "--memory-limit", a->memory_limit_gb, 0, 1e6,
             "memory limit of a run whose options set none, GB; default: 80 % of the memory "
             "of the machine or job, divided by --jobs")
      ->type_name("GB")
      ->default_str("");
  add_integer(*app, "--jobs", a->jobs, {1, 1024},
              "number of concurrent runs; default: cores that this process may use, divided by "
              "the threads of a run")
      ->type_name("J")
      ->default_str("");
  add_integer(*app, "--seed", a->defaults.seed, kSeeds, "seed of runs whose options set none");
  app->add_flag("--keep-plans", a->keep_plans,
                "keep the plan files as DIR/plans/NAME/ID.plan.json; with a seed other than 0, for "
                "instance 7, under NAME+seed7");
  app->add_flag(
      "--certify", a->certify,
      "write a certificate of the lower bound of each run of Grove, and check it by grove-verify: "
      "column certified");
  app->add_flag("--quiet", a->quiet, "do not show progress");
  app->callback([app, a] { run(*app, *a); });
}

}  // namespace grove::detail
