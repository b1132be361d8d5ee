// SPDX-License-Identifier: MIT
// Finding out before a bench whether its methods take its instances at all.
#pragma once

#include <vector>

#include "tools/bench/bench_run.h"

namespace grove::detail::bench {

// Lets every method begin on one instance of each problem there is (cts, mg, ...), with a time
// limit of 0. Throws InputError with the program's words where it refuses (exit code 2): so would
// it every other. What else may go wrong is left to rows. Leaves nothing behind.
void rehearse(const std::vector<BenchInstance>& instances, const std::vector<Method>& methods,
              const BenchOptions& options);

}  // namespace grove::detail::bench
