// SPDX-License-Identifier: MIT
// Runs methods on instances: schedules the runs and stores their results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/bench_instances.h"
#include "tools/bench/external_solver.h"
#include "tools/bench/progress_text.h"

namespace grove::detail::bench {

struct Method {
  batch::Settings settings;  // the method's name is unique and names files
  std::int64_t threads = 1;
  // Arguments after `grove solve INSTANCE`, except for the time limit and the plan file.
  std::vector<std::string> arguments = {};
  // External solvers: limit of the data segment (RLIMIT_DATA), GB; nullopt: no limit.
  std::optional<double> memory_gb = {};
  // The external solver; nullptr: Grove.
  std::shared_ptr<const ExternalSolver> solver = {};
};

struct BenchOptions {
  std::string program;  // path of grove
  std::filesystem::path folder;
  int jobs = 1;
  bool keep_plans = false;
  std::string verify;       // path of grove-verify; "": without certificates
  double root_cost_s = 10;  // time limit for the root cost of an instance
  double root_cost_gb = 1;  // limit of the memory of this process while it computes one
  double grace_s = 10;      // a run is killed at grace_factor * limit + grace_s; an
                            // external solver that does not receive the limit: at the limit
  double grace_factor = 1.1;
  std::string version;            // for rows of runs that do not report one
  std::string machine;            // description of the processor, for the rows
  std::function<bool()> stopped;  // whether the user wants to stop; called by any thread
  std::function<void(const BenchState&)> watch;  // called several times a second
};

// Returns the command line of one run.
std::vector<std::string> solve_command(const std::string& program, const batch::Entry& entry,
                                       const Method& method, double time_limit_s,
                                       const std::filesystem::path& plan);

// Runs all methods on all instances, and resumes an earlier benchmark in the same folder. All
// methods run on one instance before the next one starts; `jobs` runs at a time, each a process of
// its own. Every plan is re-checked. Ends when all runs are done, or soon after options.stopped()
// returns true; runs in progress are then killed and get no row. Returns the state at the end.
// Throws InputError if the folder cannot be used or holds rows of other runs, and
// std::system_error.
BenchState run_bench(const std::vector<BenchInstance>& instances,
                     const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
