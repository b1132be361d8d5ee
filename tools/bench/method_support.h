// SPDX-License-Identifier: MIT
// Checks before a benchmark starts that its methods accept its instances.
#pragma once

#include <vector>

#include "tools/bench/bench_run.h"

namespace grove::detail::bench {

// Starts every method of Grove on one instance of each kind, with a time limit of 0. Throws
// InputError if a method refuses all of them (exit code 2), because then an option is wrong or no
// instance suits the method. Other failures are left to the rows of the runs. Deletes all files
// that it made.
void check_method_support(const std::vector<BenchInstance>& instances,
                          const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
