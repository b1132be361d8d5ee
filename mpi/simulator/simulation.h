// SPDX-License-Identifier: MIT
// Simulates a distributed search on a machine with many processors, in one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solve.h"
#include "mpi/simulator/machine.h"
#include "mpi/simulator/simulated_worker.h"
#include "planning/problem.h"

namespace grove::detail {

// Result of a simulation. All times are in seconds. They are times of the simulated clock, which
// starts when all ranks are ready, except processor times, which are real.
struct SimulatedRun {
  static constexpr int kParts = 100;

  struct Rank {
    SimulatedWorker::Tally worker;
    double communication_s = 0;
    std::int64_t messages = 0;  // messages sent
    std::int64_t bytes = 0;
    std::int64_t received = 0;  // messages received
    double waited_s = 0;        // time from arrival to handling, summed over the messages
    double communication_processor_s = 0;  // real time of everything except expansions
  };

  // False: a limit was reached before the end, and the other fields describe the run so far.
  bool ended = false;
  Solution solution;  // includes the counts of the ranks if `ended`
  double wall_s = 0;  // until the solution was known and all ranks had finished
  std::vector<Rank> ranks;
  std::vector<double> busy;  // mean number of busy workers in each of kParts equal parts of wall_s
};

// Simulates `ranks` ranks with one worker each. `options.start` should be a good plan, because
// simulated ranks run no primal search. `limits` apply to the simulation, in real time. Throws what
// solve() throws, and std::logic_error if no event is left although the run has not ended.
SimulatedRun simulate(const Problem& problem, const SolveOptions& options, const Limits& limits,
                      int ranks, const Machine& machine);

}  // namespace grove::detail
