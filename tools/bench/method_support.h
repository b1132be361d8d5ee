// SPDX-License-Identifier: MIT
// Finding out before a bench whether its methods take its instances at all.
#pragma once

#include <vector>

#include "tools/bench/bench_run.h"

namespace grove::detail::bench {

// Starts every method on one instance of each kind, with a time limit of 0. Throws InputError if it
// refuses all of them (exit code 2): then an option is wrong, or the method suits no instance. Any
// other failure, and solvers of others, are left to the rows. Leaves nothing behind.
void check_method_support(const std::vector<BenchInstance>& instances,
                          const std::vector<Method>& methods, const BenchOptions& options);

}  // namespace grove::detail::bench
