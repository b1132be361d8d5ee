// SPDX-License-Identifier: MIT
#include "tools/solve/solve_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>

#include "engine/choices.h"
#include "io/input_error.h"
#include "model/choices.h"
#include "tools/common/options.h"
#include "tools/common/parse_error.h"
#include "tools/common/signals.h"

namespace grove::detail {
namespace {

const std::string kDefaultOmega = fmt::format("{}", kDefaults.omega);
constexpr IntegerRange kTreeNodes{0, 1'000'000};
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

std::string check_backend(const std::string& text) {
  return is_built(kBackends.at(text)) ? "" : "Grove was built without CBC; expected auto or dp";
}

std::string check_method(const std::string& text) {
  if (parse_method(text)) return {};
  std::string names;
  for (Method method : all_methods())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(method));
  return fmt::format("found '{}'; expected one of {} (CTS-CBS as in the paper: --policy fixed)",
                     text, names);
}

template <typename Value>
std::vector<std::string> keys_of(const std::map<std::string, Value>& table) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : table) keys.push_back(key);
  return keys;
}

std::string names_of_techniques() {
  std::string names;
  for (const auto& [t, name] : kTechniques)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  return names;
}

std::string check_technique(const std::string& text) {
  if (parse_technique(text)) return {};
  if (std::ranges::find(kRemovedTechniques, text) != kRemovedTechniques.end())
    return fmt::format("the technique '{}' was removed from Grove; expected one of {}", text,
                       names_of_techniques());
  return fmt::format("found '{}'; expected one of {}", text, names_of_techniques());
}

// Returns the error message for --with, which older versions accepted. All techniques are now on by
// default.
std::string refuse_with(const std::string& text) {
  if (std::ranges::find(kRemovedTechniques, text) != kRemovedTechniques.end())
    return fmt::format("the technique '{}' was removed from Grove; expected no --with", text);
  return fmt::format("found '{}'; every technique is on by default; expected no --with", text);
}

Techniques techniques_of(const SolveArguments& arguments) {
  Techniques techniques = Techniques::defaults();
  for (const std::string& name : arguments.without)
    techniques = techniques.without(*parse_technique(name));
  return techniques;
}

std::string help_on_tuning() {
  std::string text =
      "--tune NAME=VALUE sets a parameter of the search, for experiments. No parameter changes "
      "what "
      "is proven.\n";
  for (const Tunable& t : tunables())
    text += fmt::format("\n{}={}  (from {} to {})\n  {}\n{}", t.name(), t.value({}), t.min, t.max,
                        t.meaning, t.evidence.empty() ? "" : fmt::format("  [{}]\n", t.evidence));
  return text;
}

std::string check_tuning(const std::string& text) {
  if (text == "help") throw CLI::CallForVersion(help_on_tuning(), 0);
  const std::string name = text.substr(0, text.find('='));
  if (const auto known = accepted_tunable_names(); std::ranges::find(known, name) == known.end()) {
    std::vector<std::string> names;
    for (const Tunable& t : tunables()) names.push_back(t.name());
    return fmt::format("found '{}'; expected one of those that '--tune help' lists{}", name,
                       suggestion(name, names));
  }
  try {
    Tuning scratch;
    set(scratch, text);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

}  // namespace

void add_omega_option(CLI::App& app, SolveArguments& a) {
  app.add_option(
         "--omega", a.omega,
         "relative tolerance: the search ends when cost <= (1 + W) * lower bound. 0: optimal plan; "
         "inf: first plan found (with --policy fixed: the first plan within the first joint task "
         "sequence)")
      ->type_name("W|inf")
      ->check(CLI::Validator(check_omega, ""))
      ->default_str(kDefaultOmega);
}

void add_method_options(CLI::App& app, SolveArguments& a) {
  app.add_option(
         "--method", a.method,
         "auto: Grove's own search. For comparison: plain CBS with the low level of optimal-cbs, "
         "hcbs or mgcbs; s-cbs: CTS-CBS with omega inf and policy fixed; cbs-ta and cbs-ts: plain "
         "CBS with one tree per assignment of goals, and of goals and tasks. For agents without a "
         "goal (only 'grove solve'): cts-cbs-a: the same as auto; cts-cbs-b: one task of each such "
         "agent becomes its goal; cts-cbs-c: cts-cbs-a for two thirds of the time, then cts-cbs-b. "
         "The paper's methods need --policy fixed")
      ->type_name("METHOD")
      ->check(CLI::Validator(check_method, ""))
      ->capture_default_str();
  app.add_flag("--anytime", a.anytime,
               "with cts-cbs-c: run cts-cbs-b first, for at most two thirds of the time, then "
               "cts-cbs-a from its plan");
  app.add_option(
         "--policy", a.policy,
         "what a tree fixes: one complete task sequence per agent (fixed: the paper's CTS-CBS), or "
         "nothing, so that one tree has all sequences (free); auto: free")
      ->type_name("auto|fixed|free")
      ->check(one_of(keys_of(kPolicies)))
      ->capture_default_str();
  app.add_option(
         "--rtsp", a.rtsp,
         "with --policy fixed, solver of the sequencing problems: dynamic programming (dp), "
         "integer programs of CBC (cbc: slow, a cross-check), or Grove's choice (auto: dp)")
      ->type_name("auto|dp|cbc")
      ->check(one_of(keys_of(kBackends)))
      ->check(CLI::Validator(check_backend, ""))
      ->capture_default_str();
  add_integer(app, "--seed", a.seed, kSeeds,
              "seed of ties among conflicts and of the primal heuristics; any value");
  app.add_option(
         "--without", a.without,
         "disable a technique of the search, for ablation studies (repeatable, or a "
         "comma-separated list). Techniques change the speed, never what the search proves: " +
             names_of_techniques())
      ->type_name("TECHNIQUE")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(check_technique, ""));
  app.add_option("--with")  // without a description, so hidden from the help
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(refuse_with, ""));
  app.add_option("--tune", a.tune)  // experimental, so hidden from the help
      ->type_name("NAME=VALUE")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(check_tuning, ""));
}

void add_search_options(CLI::App& app, SolveArguments& a) {
  add_omega_option(app, a);
  add_number(app, "--time-limit", a.time_limit_s, 0, 1e9,
             "time limit, seconds from the start of the program; then the run ends with the best "
             "plan so far")
      ->type_name("S");
  add_number(
      app, "--memory-limit", a.memory_limit_gb, 0, 1e6,
      "memory limit of the process, GB. Near it the search frees what it can recompute, then "
      "evicts its worst nodes and keeps their bound; if that is not enough, it stops. Default: "
      "80 % of the memory of the machine, or of what cgroups or the Slurm job allow")
      ->type_name("GB");
  add_integer(app, "--threads", a.threads, {1, 1024},
              "number of search threads; default: one for each core that this process may use")
      ->type_name("T");
  add_method_options(app, a);
}

void add_file_options(CLI::App& app, SolveArguments& a) {
  app.add_option("--start", a.start,
                 "plan file of this instance; its plan is checked and becomes the first incumbent")
      ->type_name("PLAN");
  app.add_option("--incumbents", a.incumbents,
                 "write every better plan, as soon as it is found, to PREFIX-1.plan.json, "
                 "PREFIX-2.plan.json, ...; files of an earlier run are removed")
      ->type_name("PREFIX");
  app.add_option(
         "--proof", a.proof,
         "write a certificate of the lower bound, which grove-verify checks without trusting "
         "this program (docs/proof.md)")
      ->type_name("FILE");
  app.add_option(
         "-o,--output", a.output,
         "plan file; default: name of the instance with .plan.json, in this directory. "
         "-: standard output, and the log goes to standard error. A file whose plan is valid for "
         "this instance is replaced only by a plan that does not cost more")
      ->type_name("PLAN");
  app.add_flag("--require-plan", a.require_plan,
               "exit with code 3 if no plan was found (grove-mpi: with 0 even then, because "
               "mpirun treats any other code as a crash)");
  add_log_options(app, a);
}

void add_log_options(CLI::App& app, SolveArguments& a) {
  app.add_option("--log", a.log, "write the log to this file as well")->type_name("FILE");
  app.add_option("--log-format", a.log_format,
                 "log as text, or as JSON lines: one JSON object per event and line")
      ->type_name("text|jsonl")
      ->check(one_of({"text", "jsonl"}))
      ->capture_default_str();
  app.add_flag("--verbose", a.verbose, "print statistics of the search at the end of the log");
  app.add_flag("--quiet", a.quiet, "do not print the log on the screen");
}

void add_solve_options(CLI::App& app, SolveArguments& a) {
  a.instance.add_to(app);
  add_search_options(app, a);
  a.instance.add_rules_to(app);
  app.add_flag(
      "--deterministic", a.deterministic,
      "make the run depend only on the work done, not on timing: it finds the same plan and writes "
      "the same log (times and memory excepted) for any number of threads, as long as it does not "
      "come near a time or memory limit. At most four threads have work. Without this option only "
      "single-threaded runs are repeatable");
  add_checkpoint_options(app, a.checkpoints);
  add_file_options(app, a);
  add_integer(app, "--log-tree", a.log_tree, kTreeNodes,
              "number of expanded nodes to log with --log-format jsonl: bound, conflict, split and "
              "children of each of the first N; 'grove view --run' draws them as a tree");
}

std::string options_text(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_positional()) continue;
    const std::string name = option->get_name();
    const bool is_flag = option->get_expected_max() == 0;
    const std::string between = option->get_delimiter() == ',' ? "," : fmt::format(" {} ", name);
    text += fmt::format(
        "{}{}{}{}", text.empty() ? "" : " ", name, is_flag ? "" : " ",
        is_flag ? "" : fmt::format("{}", fmt::join(option->reduced_results(), between)));
  }
  return text;
}

Method method_of(const SolveArguments& a) {
  return *parse_method(a.method);
}

Omega omega_of(const SolveArguments& a) {
  return Omega::parse(a.omega.empty() ? kDefaultOmega : a.omega);
}

SolveOptions solve_options(const SolveArguments& a) {
  if (a.anytime && method_of(a) != Method::kCtsCbsC)
    throw CLI::ValidationError("--anytime", "requires --method cts-cbs-c");
  SolveOptions options;
  if (method_of(a) == Method::kSCbs && !a.omega.empty() && !omega_of(a).is_infinite())
    throw CLI::ValidationError("--method s-cbs",
                               fmt::format("requires omega inf; found --omega {}", a.omega));
  options.omega = omega_of(a);
  options.policy = kPolicies.at(a.policy);
  options.rtsp = kBackends.at(a.rtsp);
  options.seed = static_cast<std::uint64_t>(a.seed);
  options.threads = static_cast<int>(a.threads);
  options.deterministic = a.deterministic;
  options.techniques = techniques_of(a);
  for (const std::string& text : a.tune) set(options.tuning, text);
  options.checkpoints.directory = a.checkpoints.directory;
  try {
    options = options_of(method_of(a), options);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("--method", error.what());
  }
  const bool is_plain = options.policy == Policy::kFixed || options.low_level != LowLevel::kOwn;
  if (is_plain && !a.without.empty())
    throw CLI::ValidationError(
        options.policy == Policy::kFixed ? "--policy fixed" : "--method " + a.method,
        "uses no techniques; found --without");
  if (a.rtsp != "auto" && options.policy != Policy::kFixed)
    throw CLI::ValidationError("--rtsp", fmt::format("requires --policy fixed; expected that, "
                                                     "or no --rtsp {}",
                                                     a.rtsp));
  return options;
}

SolveOptions options_of_one_search(const SolveArguments& a) {
  if (is_adaptation(method_of(a)))
    throw CLI::ValidationError("--method " + a.method,
                               "only for 'grove solve'; expected another method (cts-cbs-a is "
                               "the same as auto)");
  return solve_options(a);
}

void require_fit(const SolveArguments& a, const Instance& instance, const SolveOptions& options) {
  try {
    require_fit(method_of(a), instance, options);
    if (!a.proof.empty()) require_certified_choices(instance);
  } catch (const InstanceError& error) {
    throw InputError(a.instance.name(), "/" + error.field(), error.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(a.instance.name(), "", error.what());
  }
}

void require_fit_of_one_search(const SolveArguments& a, const Instance& instance,
                               const SolveOptions& options, std::string_view program) {
  a.instance.require_no_choices(instance, fmt::format("{} does not support", program),
                                "'grove solve'");
  require_fit(a, instance, options);
}

LoadedInstance load(SolveArguments& a, bool prints_messages) {
  a.instance.limit_memory(a.memory_limit_gb);
  LoadedInstance loaded = a.instance.load(prints_messages);
  if (prints_messages && !a.quiet) print_hints(loaded.hints);
  return loaded;
}

void set_limits(Limits& limits, const SolveArguments& a,
                std::chrono::steady_clock::time_point start) {
  using Clock = Limits::Clock;
  limits.set_deadline(start + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(a.time_limit_s)));
  limits.set_memory_limit(static_cast<std::size_t>(a.memory_limit_gb * 1e9));
  limits.watch_interrupt(&interrupted);
}

}  // namespace grove::detail
