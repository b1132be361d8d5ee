// SPDX-License-Identifier: MIT
// The methods of a bench, as the command line names them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/bench_run.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// What holds for runs that do not say otherwise.
struct RunDefaults {
  double time_limit_s = *kDefaults.time_limit;
  std::optional<double> memory_limit_gb = {};  // none: by the machine
  std::int64_t seed = 0;
};

// Reads "NAME: OPTIONS OF grove solve" as `grove solve` itself would, so that a slip is found
// before anything runs; "NAME" alone is short for "NAME: --method NAME". Options that name files
// are the bench's own. Throws CLI::ValidationError, naming the run.
bench::Method read_run(const std::string& text, const RunDefaults& defaults);

// The same of several, whose names must differ.
std::vector<bench::Method> read_runs(const std::vector<std::string>& texts,
                                     const RunDefaults& defaults);

}  // namespace grove::detail
