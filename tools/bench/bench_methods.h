// SPDX-License-Identifier: MIT
// Parses the values of --run, which define the Grove methods of a benchmark.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/bench_run.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// Values for runs that do not set them by their own options.
struct RunDefaults {
  double time_limit_s = *kDefaults.time_limit;
  std::optional<double> memory_limit_gb = {};  // nullopt: an equal share of the machine's memory
  std::int64_t seed = 0;
};

// Parses "NAME: OPTIONS", where OPTIONS are options of `grove solve`, with that command's parser,
// so that errors are reported before any run starts. "NAME" without a colon is short for
// "NAME: --method NAME". Refuses the options for the instance, checkpoints, log and other files,
// because the benchmark chooses these. Throws CLI::ValidationError, which names the run.
bench::Method read_run(const std::string& text, const RunDefaults& defaults);

// Parses several runs as read_run() does. Also throws CLI::ValidationError if two have the same
// name.
std::vector<bench::Method> read_runs(const std::vector<std::string>& texts,
                                     const RunDefaults& defaults);

}  // namespace grove::detail
