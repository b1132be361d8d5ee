// SPDX-License-Identifier: MIT
// Checks, before a benchmark starts, that each method accepts some of the instances.
#pragma once

#include <vector>

#include "tools/bench/bench_run.h"

namespace grove::detail::bench {

// Starts every Grove method on one instance of each kind, with a time limit of 0. Throws InputError
// if a method refuses all of them (exit code 2), because then an option is wrong or no instance
// suits the method. Ignores other failures; they appear in the rows of the runs. Deletes all files
// that the methods write.
void check_method_support(const std::vector<BenchInstance>& instances,
                          const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
