// SPDX-License-Identifier: MIT
// Command-line options of `grove solve` and of other commands that search.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/method.h"
#include "grove/solve.hpp"
#include "model/limits.h"
#include "tools/common/instance_arguments.h"
#include "tools/solve/checkpoint_arguments.h"

namespace grove::detail {

// The library's defaults, which are also those of the command line.
inline const Options kDefaults;

struct SolveArguments {
  InstanceArguments instance;
  std::string omega;  // "" if not given
  double time_limit_s = *kDefaults.time_limit;
  double memory_limit_gb = static_cast<double>(*kDefaults.memory_limit) / 1e9;
  std::int64_t threads = kDefaults.threads;
  std::string method = kDefaults.method;
  bool anytime = false;
  std::string policy = "auto";
  std::string rtsp = "auto";
  std::int64_t seed = static_cast<std::int64_t>(kDefaults.seed);
  std::vector<std::string> without;
  std::vector<std::string> tune;
  bool deterministic = kDefaults.deterministic;
  CheckpointArguments checkpoints;
  std::filesystem::path start;
  std::string incumbents;
  std::filesystem::path proof;
  std::filesystem::path output;
  bool keeps_cheaper = true;  // keep a cheaper valid plan that is already in the output file
  bool require_plan = false;
  std::filesystem::path log;
  std::string log_format = "text";
  std::int64_t log_tree = 0;
  bool verbose = false;
  bool quiet = false;
};

// Add groups of options with their ranges, defaults and help: search, tolerance, method, files of
// the run, log. The search options include tolerance and method, and the file options include the
// log. `arguments` must outlive the parsing of the command line.
void add_search_options(CLI::App& app, SolveArguments& arguments);
void add_omega_option(CLI::App& app, SolveArguments& arguments);
void add_method_options(CLI::App& app, SolveArguments& arguments);
void add_file_options(CLI::App& app, SolveArguments& arguments);
void add_log_options(CLI::App& app, SolveArguments& arguments);
// Adds all options of `grove solve`.
void add_solve_options(CLI::App& app, SolveArguments& arguments);

// Returns the options that the user gave, as a command line without positional arguments.
std::string options_text(const CLI::App& app);

Method method_of(const SolveArguments& arguments);
Omega omega_of(const SolveArguments& arguments);
// Returns the options for the engine, without the start plan. Throws CLI::ValidationError if the
// arguments contradict each other.
SolveOptions solve_options(const SolveArguments& arguments);
// Like solve_options(), for programs that run a single search themselves. Also throws
// CLI::ValidationError for the methods that adapt CTS-CBS (is_adaptation()).
SolveOptions options_of_one_search(const SolveArguments& arguments);
// Throws InputError if the method does not support the instance, or the start plan in `options`.
void require_fit(const SolveArguments& arguments, const Instance& instance,
                 const SolveOptions& options);
// As above, for programs that run a single search themselves, and thus support no choices.
// `program`: its name, such as "grove-mpi".
void require_fit_of_one_search(const SolveArguments& arguments, const Instance& instance,
                               const SolveOptions& options, std::string_view program);
// Loads the instance within the memory limit of the run; see InstanceArguments::load().
LoadedInstance load(SolveArguments& arguments, bool prints_messages = true);
// Sets the time limit (from `start`), the memory limit and the interrupt flag of a run.
void set_limits(Limits& limits, const SolveArguments& arguments,
                std::chrono::steady_clock::time_point start);

}  // namespace grove::detail
