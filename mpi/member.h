// SPDX-License-Identifier: MIT
// One end of a distributed search.
#pragma once

#include <memory>

#include "grove/detail/engine/run_observer.h"
#include "mpi/coordinator.h"
#include "mpi/rank.h"
#include "mpi/transport.h"

namespace grove::detail {

// A rank, and on rank 0 the coordinator beside it, which share a transport. Of one thread, but for
// what Rank says otherwise.
class Member {
 public:
  // All must outlive this, but for `stops`; see Rank. The observer hears of the run on rank 0.
  Member(const Problem& problem, const SolveOptions& options, const Limits& limits,
         RunObserver& observer, Transport& transport, const AgentStopsStore& stops);
  Member(const Problem& problem, const SolveOptions& options, const Limits& limits,
         RunObserver& observer, Transport& transport)
      : Member(problem, options, limits, observer, transport,
               AgentStopsStore(problem.instance, problem.distances)) {}

  // Handles what has arrived and says what is new. `now` in seconds of any clock. True if anything
  // had arrived.
  bool converse(double now);

  Rank& rank() { return rank_; }
  // Null but on rank 0.
  Coordinator* coordinator() { return coordinator_.get(); }
  // Is nothing more to be said, nor to come?
  bool left() const { return rank_.left(); }

 private:
  Transport& transport_;
  Rank rank_;
  std::unique_ptr<Coordinator> coordinator_;
};

}  // namespace grove::detail
