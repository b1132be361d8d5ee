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
#include "planning/problem.h"

namespace grove::detail {

// Thrown on rank 0 if a limit was reached and some ranks are unresponsive. The transport then
// cannot be closed, and collective calls are impossible, so the caller must end all processes of
// the job.
struct UnresponsiveRanks : std::runtime_error {
  UnresponsiveRanks(Solution found, std::int64_t count);

  Solution solution;   // concluded without further messages from these ranks
  std::int64_t ranks;  // number of unresponsive ranks
};

// Solves with all ranks of `transport`. Each rank calls this with the same problem and options,
// except for its own number of threads. The calling thread communicates and calls `poll` every few
// milliseconds; other threads search. Rank 0 returns the solution, the other ranks return nullopt.
// A limit reached on any rank ends the run. On rank 0 `observer` receives the events of the run,
// except on_expanded() and on_evicted(). `options.deterministic` must not be set.
//
// Throws what solve() throws. Rank 0 throws UnresponsiveRanks; the other ranks then wait until the
// caller of rank 0 ends their processes. A rank other than 0 throws std::runtime_error if rank 0 is
// unresponsive: the rank has received nothing for `--tune unresponsive-timeout` seconds, and the
// time limit was reached at least as long ago.
std::optional<Solution> solve_distributed(const Problem& problem, const SolveOptions& options,
                                          const Limits& limits, Transport& transport,
                                          RunObserver& observer, const std::function<void()>& poll);

}  // namespace grove::detail
