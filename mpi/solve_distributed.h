// SPDX-License-Identifier: MIT
// A solve by several processes.
#pragma once

#include <functional>
#include <optional>

#include "grove/detail/engine/run_observer.h"
#include "grove/detail/engine/solve.h"
#include "grove/detail/search/problem.h"
#include "mpi/transport.h"

namespace grove::detail {

// Solves with all ranks of `transport`, each of which calls this with the same problem and options
// but for its own number of threads; the calling thread speaks, others search. Rank 0 returns the
// answer, the others nothing. The limits of rank 0 are the run's, but any rank's limits may stop
// it. `meanwhile` is called about every millisecond. `observer` hears of the run on rank 0; of
// single nodes it hears of roots only. `options.deterministic` must not be set. Throws what solve()
// does; the others then wait for this rank, until their process is ended from outside.
std::optional<Solution> solve_distributed(const Problem& problem, const SolveOptions& options,
                                          const Limits& limits, Transport& transport,
                                          RunObserver& observer,
                                          const std::function<void()>& meanwhile);

}  // namespace grove::detail
