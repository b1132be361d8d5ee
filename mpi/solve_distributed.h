// SPDX-License-Identifier: MIT
// Solves an instance with several processes.
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

// Thrown on rank 0: a limit was reached and some ranks are unresponsive. The transport cannot be
// closed then, and collective calls are impossible. The processes must be ended from outside.
struct UnresponsiveRanks : std::runtime_error {
  UnresponsiveRanks(Solution found, std::int64_t count);

  Solution solution;   // the solution without these ranks
  std::int64_t ranks;  // number of unresponsive ranks
};

// Solves with all ranks of `transport`. Each rank calls this with the same problem and options,
// except for its own number of threads. The calling thread communicates, other threads search. Rank
// 0 returns the solution, the other ranks return nullopt. The limits of rank 0 are those of the
// run, but the limits of any rank may stop it. `poll` is called every few milliseconds. On
// rank 0 `observer` receives the events of the run; of single nodes it receives only roots.
// `options.deterministic` must not be set. Throws what solve() throws. Rank 0 throws
// UnresponsiveRanks; the other ranks then wait for rank 0 until their process is ended from
// outside. They throw std::runtime_error if rank 0 is unresponsive: if they have received nothing
// for `--tune unresponsive-timeout` seconds, and the time limit was that long ago.
std::optional<Solution> solve_distributed(const Problem& problem, const SolveOptions& options,
                                          const Limits& limits, Transport& transport,
                                          RunObserver& observer,
                                          const std::function<void()>& poll);

}  // namespace grove::detail
