// SPDX-License-Identifier: MIT
// One end of a distributed search.
#pragma once

#include <deque>
#include <memory>

#include "engine/run_observer.h"
#include "mpi/coordinator.h"
#include "mpi/rank.h"
#include "mpi/sub_coordinator.h"
#include "mpi/transport.h"

namespace grove::detail {

// A rank, and the coordinators beside it if there are any, which share a transport. Of one thread,
// but for what Rank says otherwise.
class RankProcess {
 public:
  // All must outlive this, but for `stops`; see Rank. The observer hears of the run on rank 0.
  RankProcess(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport, const AgentStopsCache& stops);
  RankProcess(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport)
      : RankProcess(problem, options, limits, observer, transport,
                    AgentStopsCache(problem.instance, problem.distances)) {}

  // Handles what has arrived and says what is new. `now` in seconds since the beginning. True if
  // anything had arrived.
  bool exchange_messages(double now);

  Rank& rank() { return rank_; }
  // When something may have to be said though nothing has happened since; infinity: never.
  double next_send_time() const;
  // The one over all; null but on rank 0.
  Coordinator* coordinator() { return coordinator_.get(); }
  // Is nothing more to be said, nor to come?
  bool left() const { return rank_.left(); }

 private:
  void handle(int from, message::Addressed&& message);

  Transport& transport_;
  Rank rank_;
  std::deque<SubCoordinator> subs_;  // by level, from 1
  std::unique_ptr<Coordinator> coordinator_;
};

}  // namespace grove::detail
