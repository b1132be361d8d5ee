// SPDX-License-Identifier: MIT
// A process of a distributed search.
#pragma once

#include <deque>
#include <memory>

#include "engine/run_observer.h"
#include "mpi/coordinator.h"
#include "mpi/rank.h"
#include "mpi/sub_coordinator.h"
#include "mpi/transport.h"

namespace grove::detail {

// A rank and the coordinators on it, if any. They share a transport. One thread at a time, except
// for the thread-safe functions of Rank.
class RankProcess {
 public:
  // All arguments must outlive this object, except `stops`; see Rank. `observer` receives the
  // events of the run on rank 0, and none on other ranks.
  RankProcess(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport, const AgentStopsCache& stops);
  RankProcess(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport)
      : RankProcess(problem, options, limits, observer, transport,
                    AgentStopsCache(problem.instance, problem.distances)) {}

  // Handles all messages that have arrived, and sends updates. `now`: seconds since the start of
  // the run. Returns true if any message had arrived.
  bool exchange_messages(double now);

  Rank& rank() { return rank_; }
  // The time at which exchange_messages() can have something to send even if nothing happens until
  // then, in seconds since the start of the run. Infinity: never.
  double next_send_time() const;
  // The top coordinator; nullptr on all ranks except 0.
  Coordinator* coordinator() { return coordinator_.get(); }
  // True if no further message will be sent or received.
  bool left() const { return rank_.left(); }

 private:
  void handle(int from, message::Addressed&& message);

  Transport& transport_;
  Rank rank_;
  std::deque<SubCoordinator> subs_;  // by level, from 1
  std::unique_ptr<Coordinator> coordinator_;
};

}  // namespace grove::detail
