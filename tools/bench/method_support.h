// SPDX-License-Identifier: MIT
// Checks, before a benchmark starts, that each Grove method accepts at least one kind of instance.
#pragma once

#include <vector>

#include "tools/bench/bench_run.h"

namespace grove::detail::bench {

// Starts every Grove method, with a time limit of 0, on one instance of each kind in turn until it
// does not refuse one. Throws InputError if a method refuses all of these instances (exit code 2),
// because then an option is wrong or no instance suits the method. Other failures are not refusals;
// they appear in the rows of the runs. Deletes all files that the methods write.
void check_method_support(const std::vector<BenchInstance>& instances,
                          const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
