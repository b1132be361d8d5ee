// SPDX-License-Identifier: MIT
// Finding out before a bench whether its methods take its instances at all.
#pragma once

#include <vector>

#include "tools/bench/bench_run.h"

namespace grove::detail::bench {

// Lets every method begin on one instance of each problem there is (cts, mg, ...), with a time
// limit of 0. What it refuses (exit code 2) is noted in Method::unsuitable, with the program's
// words: so would it refuse every other. Throws InputError if it refuses all there are. What else
// may go wrong is left to rows, and so are solvers of others. Leaves nothing behind.
void rehearse(const std::vector<BenchInstance>& instances, std::vector<Method>& methods,
              const BenchOptions& options);

}  // namespace grove::detail::bench
