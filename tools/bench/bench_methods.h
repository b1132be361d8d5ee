// SPDX-License-Identifier: MIT
// Methods of a benchmark: parses the values of --run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/bench_run.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// Defaults for runs whose options do not set these values.
struct RunDefaults {
  double time_limit_s = *kDefaults.time_limit;
  std::optional<double> memory_limit_gb = {};  // nullopt: a share of the machine's memory
  std::int64_t seed = 0;
};

// Parses "NAME: OPTIONS OF grove solve" with the option parser of `grove solve`, so that a mistake
// is found before any run starts. "NAME" without a colon is short for "NAME: --method NAME".
// Options that name files are refused, because the benchmark sets them. Throws
// CLI::ValidationError, which names the run.
bench::Method read_run(const std::string& text, const RunDefaults& defaults);

// The same for several runs, whose names must be distinct.
std::vector<bench::Method> read_runs(const std::vector<std::string>& texts,
                                     const RunDefaults& defaults);

}  // namespace grove::detail
