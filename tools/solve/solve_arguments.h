// SPDX-License-Identifier: MIT
// What one asks of a solve on the command line.
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

// Those of the library: what is not said is the same for programs and for their users.
inline const Options kDefaults;

struct SolveArguments {
  InstanceArguments instance;
  std::string omega;  // empty: not given
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
  bool keeps_cheaper = true;  // a cheaper valid plan that is in the output file already
  bool require_plan = false;
  std::filesystem::path log;
  std::string log_format = "text";
  std::int64_t log_tree = 0;
  bool verbose = false;
  bool quiet = false;
};

// Adds the options of a search - names, ranges, defaults and the texts of the help, once - and
// those that name the files of one run. `arguments` must outlive the parsing.
void add_search_options(CLI::App& app, SolveArguments& arguments);
// Parts of them: how good the plan must be, and by what means it is sought.
void add_omega_option(CLI::App& app, SolveArguments& arguments);
void add_method_options(CLI::App& app, SolveArguments& arguments);
void add_file_options(CLI::App& app, SolveArguments& arguments);
void add_log_options(CLI::App& app, SolveArguments& arguments);
// All that `grove solve` knows.
void add_solve_options(CLI::App& app, SolveArguments& arguments);

// What was asked for that is not the default, as one types it.
std::string options_text(const CLI::App& app);

Method method_of(const SolveArguments& arguments);
Omega omega_of(const SolveArguments& arguments);
// For the engine, but for the start plan. Throws CLI::ValidationError when they do not fit
// together.
SolveOptions solve_options(const SolveArguments& arguments);
// The same for programs that run solve()'s search themselves: not for all methods.
SolveOptions options_of_one_search(const SolveArguments& arguments);
// Throws InputError if the method is not for this instance, or not with this start plan.
void require_fit(const SolveArguments& arguments, const Instance& instance,
                 const SolveOptions& options);
// The instance, by the memory limit of the search; see InstanceArguments::load.
LoadedInstance load(SolveArguments& arguments, bool speaks = true);
// The limits of a run that began at `start`.
void set_limits(Limits& limits, const SolveArguments& arguments,
                std::chrono::steady_clock::time_point start);

}  // namespace grove::detail
