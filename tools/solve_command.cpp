// SPDX-License-Identifier: MIT
// grove solve: files in, log and plan file out.
#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "commands.h"
#include "grove/engine/solve.h"
#include "grove/io/atomic_file.h"
#include "grove/io/input_error.h"
#include "grove/io/plan_file.h"
#include "incumbent_files.h"
#include "instance_arguments.h"
#include "options.h"
#include "run_log.h"
#include "start_plan.h"
#include "version.h"

namespace grove {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kFooter =
    "The plan file says how the run ended: optimal, bounded (within omega), feasible (a plan "
    "outside\n"
    "omega), unknown (no plan when a limit struck) or infeasible (proven). Its lower_bound is "
    "proven\n"
    "whatever the status. Ctrl-C and SIGTERM end the run like a time limit: with the best plan so "
    "far.\n"
    "\n"
    "Examples:\n"
    "  grove solve benchmarks/data/first.cts.json\n"
    "  grove solve INSTANCE.cts.json --omega 0 --time-limit 60 --output plan.json\n"
    "  grove solve room-32-32-4-random-1.scen --map room-32-32-4.map --agents 20";

std::atomic<bool> interrupted{false};

extern "C" void on_signal(int) {
  interrupted = true;
}

// The first Ctrl-C, SIGTERM or hang-up ends the search; a second one has its usual effect. A reader
// of the log that goes away (`| head`) must not take the plan with it.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

double physical_memory_gb() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e9;
}

// The cores that this process may use.
int usable_cores() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
}

struct SolveArguments {
  InstanceArguments instance;
  std::string omega = "0.01";
  double time_limit_s = 180;
  double memory_limit_gb = std::floor(8 * physical_memory_gb()) / 10;
  std::int64_t threads = usable_cores();
  std::string policy = "auto";
  std::string rtsp = "auto";
  std::int64_t seed = 0;
  std::vector<std::string> with;
  std::vector<std::string> without;
  bool deterministic = false;
  std::filesystem::path start;
  std::string incumbents;
  std::filesystem::path output;
  std::filesystem::path log;
  bool quiet = false;
};

const std::map<std::string, Policy> kPolicies{
    {"auto", Policy::kAuto}, {"fixed", Policy::kFixed}, {"free", Policy::kFree}};
const std::map<std::string, RtspBackend> kBackends{
    {"auto", RtspBackend::kAuto}, {"dp", RtspBackend::kAuto}, {"cbc", RtspBackend::kCbc}};

std::string check_omega(const std::string& text) {
  try {
    Omega::parse(text);
    return {};
  } catch (const std::invalid_argument& error) {
    return fmt::format("found '{}'; {}", text, error.what());
  }
}

// A value must be one of the table's keys.
template <typename Value>
CLI::Validator one_of(const std::map<std::string, Value>& table) {
  return CLI::Validator(
      [&table](const std::string& text) {
        if (table.contains(text)) return std::string();
        std::string names;
        for (const auto& [name, value] : table) names += (names.empty() ? "" : ", ") + name;
        return fmt::format("found '{}'; expected one of {}", text, names);
      },
      "");
}

std::string names_of(Techniques techniques) {
  std::string names;
  for (Technique t : all_techniques())
    if (techniques.has(t)) names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(t));
  return names;
}

// A technique that is used by default, or one that is not.
CLI::Validator technique_of(Techniques known) {
  return CLI::Validator(
      [known](const std::string& text) {
        const auto technique = parse_technique(text);
        if (technique && known.has(*technique)) return std::string();
        return fmt::format("found '{}'; expected one of {}", text, names_of(known));
      },
      "");
}

Techniques techniques_of(const SolveArguments& arguments) {
  Techniques techniques = Techniques::usual();
  for (const std::string& name : arguments.with)
    techniques = techniques.with(*parse_technique(name));
  for (const std::string& name : arguments.without)
    techniques = techniques.without(*parse_technique(name));
  return techniques;
}

// The option table of grove solve: names, ranges, defaults and the texts of the help, once.
void add_options(CLI::App& app, SolveArguments& a) {
  a.instance.add_to(app);
  app.add_option(
         "--omega", a.omega,
         "how far from optimal the plan may be: cost <= (1 + W) * lower bound. 0 asks for an "
         "optimal plan, inf for the first plan found (with --policy fixed: that the first joint "
         "task "
         "sequence allows)")
      ->type_name("W|inf")
      ->check(CLI::Validator(check_omega, ""))
      ->capture_default_str();
  add_number(app, "--time-limit", a.time_limit_s, 0, 1e9,
             "stop after so many seconds with what there is")
      ->type_name("S");
  add_number(app, "--memory-limit", a.memory_limit_gb, 0, 1e6,
             "stay below so many gigabytes: forget what can be found again, then give up the worst "
             "nodes, whose bound still counts; stop if that does not help. By default 80 % of the "
             "machine's")
      ->type_name("GB");
  add_integer(app, "--threads", a.threads, {1, 1024},
              "search on so many threads. By default one for each core that this process may use")
      ->type_name("T");
  app.add_option(
         "--policy", a.policy,
         "what a tree of the forest fixes: a complete task sequence for every agent (fixed: the "
         "paper's CTS-CBS), or nothing, so that one tree holds all sequences (free); auto: "
         "free")
      ->type_name("auto|fixed|free")
      ->check(one_of(kPolicies))
      ->capture_default_str();
  app.add_option("--rtsp", a.rtsp,
                 "with fixed, what solves the sequencing problems: dynamic programming (dp), the "
                 "integer programs of "
                 "CBC (cbc: slow, a cross-check), or Grove's choice (auto: dp)")
      ->type_name("auto|dp|cbc")
      ->check(one_of(kBackends))
      ->capture_default_str();
  add_integer(
      app, "--seed", a.seed, kSeeds,
      "breaks ties among conflicts and guides the search for plans: another seed, another run");
  const Techniques unusual = Techniques::all().without(Techniques::usual());
  app.add_option("--without", a.without,
                 "do without a technique of the search, for ablation studies; several with commas. "
                 "Techniques change how fast the search is, never what it proves: " +
                     names_of(Techniques::usual()))
      ->type_name("TECHNIQUE")
      ->delimiter(',')
      ->check(technique_of(Techniques::usual()));
  app.add_option(
         "--with", a.with,
         "use a technique that is not used by default, in the same way: " + names_of(unusual))
      ->type_name("TECHNIQUE")
      ->delimiter(',')
      ->check(technique_of(unusual));
  app.add_flag(
      "--deterministic", a.deterministic,
      "let what happens depend on the work done alone: runs that come near no time or memory limit "
      "then find the same plan and log the same, times and memory aside, whatever the number of "
      "threads. (Without it only runs on one thread do.)");
  app.add_option("--start", a.start,
                 "a plan file of this instance: its plan is checked and is the first incumbent")
      ->type_name("PLAN");
  app.add_option("--incumbents", a.incumbents,
                 "write every better plan, as soon as it is found, to PREFIX-1.plan.json, "
                 "PREFIX-2.plan.json and so on; those of an earlier run are removed")
      ->type_name("PREFIX");
  app.add_option("--output", a.output,
                 "the plan file; by default the instance's name with .plan.json, in this directory")
      ->type_name("PLAN");
  app.add_option("--log", a.log, "write the log to this file too")->type_name("FILE");
  app.add_flag("--quiet", a.quiet, "no log on the screen");
}

std::string machine_text() {
  utsname name{};
  ::uname(&name);
  return fmt::format("{} {} {}, {} cores, {:.1f} GB", name.nodename, name.sysname, name.machine,
                     std::thread::hardware_concurrency(), physical_memory_gb());
}

// What was asked for that is not the default, as one types it.
std::string options_text(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_positional()) continue;
    const bool is_flag = option->get_expected_max() == 0;
    text += fmt::format("{}{}{}{}", text.empty() ? "" : " ", option->get_name(), is_flag ? "" : " ",
                        is_flag ? "" : fmt::format("{}", fmt::join(option->results(), ",")));
  }
  return text;
}

std::string count_text(int count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string agents_text(const Instance& instance) {
  const auto free_ends =
      std::ranges::count_if(instance.agents(), [](const Agent& agent) { return !agent.goal; });
  return count_text(instance.agent_count(), "agent") +
         (free_ends == 0 ? "" : fmt::format(" ({} without a goal)", free_ends));
}

void log_head(LogSink& sink, const CLI::App& app, const SolveArguments& a,
              const LoadedInstance& loaded) {
  const Instance& instance = loaded.instance;
  const std::string options = options_text(app);
  sink.line(fmt::format("{} on {}", version_text(), machine_text()));
  sink.line(fmt::format("Instance      {}: {}, {}", a.instance.path(), agents_text(instance),
                        count_text(instance.task_count(), "task")));
  sink.line(fmt::format("Map           {}: {} x {}, {} passable cells", loaded.map_path.string(),
                        instance.grid().width(), instance.grid().height(),
                        instance.grid().passable_count()));
  sink.line(fmt::format("Options       {}", options.empty() ? "all defaults" : options));
  sink.line(fmt::format("Threads       {}{}", a.threads, a.deterministic ? ", deterministic" : ""));
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

void set_limits(Limits& limits, const SolveArguments& a, Clock::time_point start) {
  limits.set_deadline(start + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(a.time_limit_s)));
  limits.set_memory_limit(static_cast<std::size_t>(a.memory_limit_gb * 1e9));
  limits.watch_interrupt(&interrupted);
}

void add_run_facts(Solution& solution, const CLI::App& app, const SolveArguments& a,
                   Clock::time_point start) {
  solution.stats.measures["wall_s"] = std::chrono::duration<double>(Clock::now() - start).count();
  solution.stats.measures["peak_memory_mb"] = static_cast<double>(peak_resident_bytes()) / 1e6;
  solution.stats.counts["seed"] = a.seed;
  solution.stats.counts["threads"] = a.threads;
  solution.stats.texts["instance"] = a.instance.path();
  solution.stats.texts["options"] = options_text(app);
  solution.stats.texts["policy"] = a.policy == "fixed" ? "fixed" : "free";
  solution.stats.texts["version"] = version_text();
}

void run_solve(const CLI::App& app, SolveArguments& a) {
  const Clock::time_point start = Clock::now();
  stop_on_signals();
  if (a.policy == "fixed" && !(a.with.empty() && a.without.empty()))
    throw CLI::ValidationError("--policy fixed",
                               "uses no techniques; expected neither --with nor --without");
  const LoadedInstance loaded = a.instance.load();
  prepare_outputs(a, loaded);
  SolveOptions options;
  options.omega = Omega::parse(a.omega);
  options.policy = kPolicies.at(a.policy);
  options.rtsp = kBackends.at(a.rtsp);
  options.seed = static_cast<std::uint64_t>(a.seed);
  options.threads = static_cast<int>(a.threads);
  options.deterministic = a.deterministic;
  options.techniques = techniques_of(a);
  if (!a.start.empty()) options.start = read_start_plan(a.start, loaded.instance);
  LogSink sink(!a.quiet, a.log);
  log_head(sink, app, a, loaded);

  Limits limits;
  set_limits(limits, a, start);
  RunLog log(sink, start, a.time_limit_s, a.deterministic);
  IncumbentFiles observer(a.incumbents, loaded.instance, options.omega, log);
  Solution solution = solve(loaded.instance, options, limits, &observer);

  add_run_facts(solution, app, a, start);
  write_solution(a.output, loaded.instance, solution);
  log.finish(solution, a.output);
}

}  // namespace

void add_solve_command(CLI::App& root) {
  CLI::App* app = root.add_subcommand("solve", "Find a plan and prove how good it is");
  app->footer(kFooter);
  const auto arguments = std::make_shared<SolveArguments>();
  add_options(*app, *arguments);
  app->callback([app, arguments] { run_solve(*app, *arguments); });
}

}  // namespace grove
