// SPDX-License-Identifier: MIT
// Command-line options of a solve.
#pragma once

#include <CLI/App.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/method.h"
#include "grove/solve.hpp"
#include "model/limits.h"
#include "tools/common/instance_arguments.h"
#include "tools/solve/checkpoint_arguments.h"

namespace grove::detail {

// Defaults of the library, so that programs and the command line have the same.
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
  bool keeps_cheaper = true;  // keep a valid plan of lower cost that is already in the output file
  bool require_plan = false;
  std::filesystem::path log;
  std::string log_format = "text";
  std::int64_t log_tree = 0;
  bool verbose = false;
  bool quiet = false;
};

// Adds the options of a search (names, ranges, defaults, help) and those that name the files of a
// run. `arguments` must outlive the parsing of the command line.
void add_search_options(CLI::App& app, SolveArguments& arguments);
// Parts of the above: tolerance; method.
void add_omega_option(CLI::App& app, SolveArguments& arguments);
void add_method_options(CLI::App& app, SolveArguments& arguments);
void add_file_options(CLI::App& app, SolveArguments& arguments);
void add_log_options(CLI::App& app, SolveArguments& arguments);
// Adds all options of `grove solve`.
void add_solve_options(CLI::App& app, SolveArguments& arguments);

// Returns the options that were given, as command-line words.
std::string options_text(const CLI::App& app);

Method method_of(const SolveArguments& arguments);
Omega omega_of(const SolveArguments& arguments);
// Returns the options for the engine, without the start plan. Throws CLI::ValidationError if they
// contradict each other.
SolveOptions solve_options(const SolveArguments& arguments);
// The same for programs that run the search of solve() themselves; not for all methods.
SolveOptions options_of_one_search(const SolveArguments& arguments);
// Throws InputError if the method does not support this instance, or this start plan.
void require_fit(const SolveArguments& arguments, const Instance& instance,
                 const SolveOptions& options);
// Loads the instance within the memory limit of the search; see InstanceArguments::load.
LoadedInstance load(SolveArguments& arguments, bool speaks = true);
// Sets the limits of a run that started at `start`.
void set_limits(Limits& limits, const SolveArguments& arguments,
                std::chrono::steady_clock::time_point start);

}  // namespace grove::detail
