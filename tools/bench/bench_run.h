// SPDX-License-Identifier: MIT
// Methods x instances: who runs what when, and what is kept of it.
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
  // What `grove solve INSTANCE` is called with, but for the time limit and the plan file.
  std::vector<std::string> arguments = {};
  // Of a program of someone else: of data; it gets no more.
  std::optional<double> memory_gb = {};
  // A program of someone else; null: Grove's own.
  std::shared_ptr<const ExternalSolver> solver = {};
};

struct BenchOptions {
  std::string program;  // grove
  std::filesystem::path folder;
  int jobs = 1;
  bool keep_plans = false;
  std::string verify;             // the checker of certificates; empty: none are asked for
  double root_cost_s = 10;        // for the root cost of an instance
  double root_cost_gb = 1;        // the process may have so much while it works one out
  double grace_s = 10;            // so much longer than its time limit a run may last, and
  double grace_factor = 1.1;      // so many times its time limit
  std::string version;            // of runs that do not say
  std::string machine;            // a text for the rows
  std::function<bool()> stopped;  // by the user; of any thread
  std::function<void(const BenchState&)> watch;  // called several times a second
};

// The command line of one run.
std::vector<std::string> solve_command(const std::string& program, const batch::Entry& entry,
                                       const Method& method, double time_limit_s,
                                       const std::filesystem::path& plan);

// Runs all methods on all instances, all on one instance before the next, `jobs` at a time, each a
// process of its own; and goes on with what an earlier bench left in the folder. Every plan is
// re-checked. Ends when all is done, or soon after options.stopped() says so: what is under way is
// then given up and has no row. Returns the state at the end. Throws InputError when the folder
// cannot be used or holds rows of other runs; std::system_error.
BenchState run_bench(const std::vector<BenchInstance>& instances,
                     const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
