// SPDX-License-Identifier: MIT
#include "tools/solve/solve_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>

#include "io/input_error.h"
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
  return is_built(kBackends.at(text)) ? ""
                                      : "this Grove was built without CBC; expected auto or dp";
}

std::string check_method(const std::string& text) {
  if (parse_method(text)) return {};
  std::string names;
  for (Method method : all_methods())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(method));
  return fmt::format("found '{}'; expected one of {} (CTS-CBS as the paper has it: --policy fixed)",
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

// No technique is off by default any more.
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
      "--tune NAME=VALUE: numbers of the search, for experiments. They change how "
      "fast it is, never what it proves.\n";
  for (const Tunable& t : tunables())
    text +=
        fmt::format("\n{}={}  (from {} to {})\n  {}\n{}", t.name(), t.value({}), t.least, t.most,
                    t.what, t.measured.empty() ? "" : fmt::format("  [{}]\n", t.measured));
  return text;
}

std::string check_tuning(const std::string& text) {
  if (text == "help") throw CLI::CallForVersion(help_on_tuning(), 0);
  std::vector<std::string> names;
  for (const Tunable& t : tunables()) names.push_back(t.name());
  const std::string name = text.substr(0, text.find('='));
  if (std::ranges::find(names, name) == names.end())
    return fmt::format("found '{}'; expected one of those that '--tune help' lists{}", name,
                       suggestion(name, names));
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
         "how far from optimal the plan may be: cost <= (1 + W) * lower bound. 0 asks for an "
         "optimal plan, inf for the first plan found (with --policy fixed: that the first joint "
         "task "
         "sequence allows)")
      ->type_name("W|inf")
      ->check(CLI::Validator(check_omega, ""))
      ->default_str(kDefaultOmega);
}

void add_method_options(CLI::App& app, SolveArguments& a) {
  app.add_option(
         "--method", a.method,
         "auto: Grove's search, as the other options say. To compare with: plain CBS with the low "
         "level of optimal-cbs, hcbs or mgcbs; s-cbs, CTS-CBS with omega inf and policy fixed. For "
         "agents without a goal ('grove solve' alone): cts-cbs-a, which is auto; cts-cbs-b, one "
         "task of each is made its "
         "goal; cts-cbs-c, cts-cbs-a for two thirds of the time, then cts-cbs-b. The paper's are "
         "those with --policy fixed")
      ->type_name("METHOD")
      ->check(CLI::Validator(check_method, ""))
      ->capture_default_str();
  app.add_flag("--anytime", a.anytime,
               "with cts-cbs-c: cts-cbs-b first, for two thirds of the time at most, then "
               "cts-cbs-a from its plan");
  app.add_option(
         "--policy", a.policy,
         "what a tree of the forest fixes: a complete task sequence for every agent (fixed: the "
         "paper's CTS-CBS), or nothing, so that one tree holds all sequences (free); auto: "
         "free")
      ->type_name("auto|fixed|free")
      ->check(one_of(keys_of(kPolicies)))
      ->capture_default_str();
  app.add_option("--rtsp", a.rtsp,
                 "with fixed, what solves the sequencing problems: dynamic programming (dp), the "
                 "integer programs of "
                 "CBC (cbc: slow, a cross-check), or Grove's choice (auto: dp)")
      ->type_name("auto|dp|cbc")
      ->check(one_of(keys_of(kBackends)))
      ->check(CLI::Validator(check_backend, ""))
      ->capture_default_str();
  add_integer(
      app, "--seed", a.seed, kSeeds,
      "breaks ties among conflicts and guides the search for plans: another seed, another run");
  app.add_option("--without", a.without,
                 "do without a technique of the search, for ablation studies; several with commas. "
                 "Techniques change how fast the search is, never what it proves: " +
                     names_of_techniques())
      ->type_name("TECHNIQUE")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(check_technique, ""));
  app.add_option("--with")  // not in the help
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(refuse_with, ""));
  app.add_option("--tune", a.tune)  // not in the help
      ->type_name("NAME=VALUE")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(check_tuning, ""));
}

void add_search_options(CLI::App& app, SolveArguments& a) {
  add_omega_option(app, a);
  add_number(app, "--time-limit", a.time_limit_s, 0, 1e9,
             "stop after so many seconds with what there is")
      ->type_name("S");
  add_number(app, "--memory-limit", a.memory_limit_gb, 0, 1e6,
             "stay below so many gigabytes: forget what can be found again, then give up the worst "
             "nodes, whose bound still counts; stop if that does not help. By default 80 % of the "
             "machine's, or of what a container or batch system grants")
      ->type_name("GB");
  add_integer(app, "--threads", a.threads, {1, 1024},
              "search on so many threads. By default one for each core that this process may use")
      ->type_name("T");
  add_method_options(app, a);
}

void add_file_options(CLI::App& app, SolveArguments& a) {
  app.add_option("--start", a.start,
                 "a plan file of this instance: its plan is checked and is the first incumbent")
      ->type_name("PLAN");
  app.add_option("--incumbents", a.incumbents,
                 "write every better plan, as soon as it is found, to PREFIX-1.plan.json, "
                 "PREFIX-2.plan.json and so on; those of an earlier run are removed")
      ->type_name("PREFIX");
  app.add_option(
         "--proof", a.proof,
         "write a certificate of the lower bound, which grove-verify checks without trusting "
         "this program (docs/proof.md)")
      ->type_name("FILE");
  app.add_option(
         "-o,--output", a.output,
         "the plan file; by default the instance's name with .plan.json, in this directory. "
         "- is standard output; the log then goes to standard error. A file whose plan is "
         "valid for this instance is replaced only by a plan that costs no more")
      ->type_name("PLAN");
  app.add_flag("--require-plan", a.require_plan,
               "end with exit code 3 if no plan was found (grove-mpi: with 0 even then, since "
               "mpirun takes anything else for a crash)");
  add_log_options(app, a);
}

void add_log_options(CLI::App& app, SolveArguments& a) {
  app.add_option("--log", a.log, "write the log to this file too")->type_name("FILE");
  app.add_option("--log-format", a.log_format,
                 "text, for people, or jsonl: one JSON object per event and line, for programs")
      ->type_name("text|jsonl")
      ->check(one_of({"text", "jsonl"}))
      ->capture_default_str();
  app.add_flag("--verbose", a.verbose, "the end of the log tells what the search did");
  app.add_flag("--quiet", a.quiet, "no log on the screen");
}

void add_solve_options(CLI::App& app, SolveArguments& a) {
  a.instance.add_to(app);
  add_search_options(app, a);
  a.instance.add_rules_to(app);
  app.add_flag(
      "--deterministic", a.deterministic,
      "let what happens depend on the work done alone: runs that come near no time or memory limit "
      "then find the same plan and log the same, times and memory aside, whatever the number of "
      "threads, of which it has work for four. (Without it only runs on one thread do.)");
  add_checkpoint_options(app, a.checkpoints);
  add_file_options(app, a);
  add_integer(app, "--log-tree", a.log_tree, kTreeNodes,
              "tell each of the first N nodes expanded in a log of format jsonl: bound, conflict, "
              "split, children; 'grove view --run' draws them as a tree");
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
    throw CLI::ValidationError("--anytime", "expected --method cts-cbs-c to go with it");
  SolveOptions options;
  if (method_of(a) == Method::kSCbs && !a.omega.empty() && !omega_of(a).is_infinite())
    throw CLI::ValidationError("--method s-cbs",
                               fmt::format("has omega inf; expected no --omega {}", a.omega));
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
        "uses no techniques; expected no --without");
  if (a.rtsp != "auto" && options.policy != Policy::kFixed)
    throw CLI::ValidationError(
        "--rtsp", fmt::format("is for trees of fixed sequences; expected --policy fixed with it, "
                              "or no --rtsp {}",
                              a.rtsp));
  return options;
}

SolveOptions options_of_one_search(const SolveArguments& a) {
  if (is_adaptation(method_of(a)))
    throw CLI::ValidationError("--method " + a.method,
                               "is for 'grove solve' alone; expected another method (cts-cbs-a is "
                               "what auto does)");
  return solve_options(a);
}

void require_fit(const SolveArguments& a, const Instance& instance, const SolveOptions& options) {
  try {
    require_fit(method_of(a), instance, options);
  } catch (const std::invalid_argument& error) {
    throw InputError(a.instance.name(), "", error.what());
  }
}

LoadedInstance load(SolveArguments& a, bool speaks) {
  a.instance.limit_memory(a.memory_limit_gb);
  return a.instance.load(speaks);
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
