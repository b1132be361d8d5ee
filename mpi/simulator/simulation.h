// SPDX-License-Identifier: MIT
// A distributed search as it would run on a machine of many processors, simulated by one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solve.h"
#include "mpi/simulator/machine.h"
#include "mpi/simulator/simulated_worker.h"
#include "search/problem.h"

namespace grove::detail {

// What became of it. Times are seconds of the simulated clock, which starts when all ranks are
// ready, unless they are said to be of a processor here.
struct SimulatedRun {
  static constexpr int kParts = 100;

  struct Rank {
    SimulatedWorker::Tally worker;
    double talking_s = 0;
    std::int64_t messages = 0;  // sent
    std::int64_t bytes = 0;
    std::int64_t received = 0;       // messages
    double waited_s = 0;             // between the arrival of each and its being dealt with, summed
    double talking_processor_s = 0;  // here: what it did but for expanding nodes
  };

  bool ended = false;  // else limits struck, and the rest says how far it came
  Solution solution;   // with what ranks counted if `ended`
  double wall_s = 0;   // until the answer was known and all had left
  std::vector<Rank> ranks;
  std::vector<double>
      busy;  // in each of kParts equal parts of wall_s: the mean number of workers busy
};

// Simulates so many ranks with one worker each. `options.start` had better be a good plan: nobody
// looks for plans beside the tree. `limits` are on the simulation itself. Throws what solve()
// throws, and std::logic_error if nothing can happen any more though the run has not ended.
SimulatedRun simulate(const Problem& problem, const SolveOptions& options, const Limits& limits,
                      int ranks, const Machine& machine);

}  // namespace grove::detail
