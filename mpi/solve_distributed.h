// SPDX-License-Identifier: MIT
// A solve by several processes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "mpi/transport.h"
#include "search/problem.h"

namespace grove::detail {

// Thrown on rank 0: a limit has struck, and some ranks say nothing any more. The transport cannot
// be left then, nor can anything be done by all; their processes must be ended from outside.
struct UnresponsiveRanks : std::runtime_error {
  UnresponsiveRanks(Solution found, std::int64_t count);

  Solution solution;   // without them
  std::int64_t ranks;  // how many
};

// Solves with all ranks of `transport`, each of which calls this with the same problem and options
// but for its own number of threads; the calling thread speaks, others search. Rank 0 returns the
// answer, the others nothing. The limits of rank 0 are the run's, but any rank's limits may stop
// it. `meanwhile` is called every few milliseconds. `observer` hears of the run on rank 0; of
// single nodes it hears of roots only. `options.deterministic` must not be set. Throws what solve()
// does. Rank 0 throws UnresponsiveRanks; the others then wait for this rank, until their process is
// ended from outside. They throw std::runtime_error if they have heard nothing for `--tune
// patience`, that long after the time limit: rank 0 stands still.
std::optional<Solution> solve_distributed(const Problem& problem, const SolveOptions& options,
                                          const Limits& limits, Transport& transport,
                                          RunObserver& observer,
                                          const std::function<void()>& meanwhile);

}  // namespace grove::detail
