// SPDX-License-Identifier: MIT
// Benchmark: runs methods on instances as child processes and stores the results.
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
  batch::Settings settings;  // the method name is part of file names; unique for each seed
  std::int64_t threads = 1;
  // For Grove: arguments after `grove solve INSTANCE`, without those that solve_command() adds.
  std::vector<std::string> arguments = {};
  // For an external solver: limit of the data segment (RLIMIT_DATA) in GB; nullopt: no limit.
  std::optional<double> memory_gb = {};
  // nullptr: the method is a configuration of Grove.
  std::shared_ptr<const ExternalSolver> solver = {};
};

struct BenchOptions {
  std::string program;           // path of grove
  std::filesystem::path folder;  // folder of the table and the kept plans
  int jobs = 1;                  // number of concurrent runs
  bool keep_plans = false;
  std::string verify;       // path of grove-verify; "": without certificates
  double root_cost_s = 10;  // time limit for computing the root cost of an instance
  double root_cost_gb = 1;  // memory limit of this process while it computes a root cost
  // A run is killed at grace_factor * limit + grace_s seconds after its start, or `limit` seconds
  // later if it writes a certificate, which it does after the limit. An external solver whose
  // command line does not contain the time limit is killed at the limit.
  double grace_s = 10;
  double grace_factor = 1.1;
  std::string version;            // of Grove; for rows of runs that do not report one
  std::string machine;            // description of the processor, for the rows
  std::function<bool()> stopped;  // true: the user wants to stop; all threads call it
  std::function<void(const BenchState&)> watch;  // called several times a second; may be empty
};

// Returns the command line of one run of Grove, without its log and its certificate.
std::vector<std::string> solve_command(const std::string& program, const batch::Entry& entry,
                                       const Method& method, double time_limit_s,
                                       const std::filesystem::path& plan);

// Runs all methods on all instances, except for runs that already have a valid row in
// options.folder. Runs are started instance by instance, each as a process of its own, at most
// options.jobs at a time. Every plan is re-checked. Returns the final state when all runs are done,
// or soon after options.stopped() returned true; runs in progress are then killed and get no row.
// Throws InputError if the folder cannot be used or contains rows with different settings, and
// std::system_error if a process cannot be created.
BenchState run_bench(const std::vector<BenchInstance>& instances,
                     const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
