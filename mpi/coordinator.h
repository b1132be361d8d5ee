// SPDX-License-Identifier: MIT
// The coordinator of a distributed search, on rank 0.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "engine/run_observer.h"
#include "engine/run_state.h"
#include "mpi/distributed_checkpoint.h"
#include "mpi/hierarchy_links.h"
#include "mpi/load_balancer.h"
#include "mpi/messages.h"
#include "mpi/rank_nodes.h"
#include "mpi/transport.h"
#include "search/node_pool.h"

namespace grove::detail {

// Holds the global bounds, checks plans, distributes trees and nodes, keeps ranks at work and ends
// the run. Lives on rank 0 and uses that rank's transport. The protocol and the proof of the lower
// bound: coordinator.cpp. One thread at a time.
class Coordinator {
 public:
  // All arguments must outlive this.
  Coordinator(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport);

  // Call this before any other function. Posts the start plan and instantiates the first tree, or
  // restores a checkpoint. Throws what reading the checkpoint throws.
  void begin();
  // Handles a message from a child. Throws std::invalid_argument for a message that a child cannot
  // send, and what GlobalBounds::post() throws.
  void handle(int from, message::Message&& message);
  // Takes due checkpoints and refills the nodes, or ends the run if it is over. Call this
  // repeatedly.
  void step();

  Cost lower_bound() { return run_.shared_bounds().lower_bound(); }
  // Has every child sent RankFinished?
  bool ended() const { return finished_children_ == children_.count(); }
  // Tests for unresponsive ranks. It acts only if a limit was reached and no message has arrived
  // for too long since then. If a checkpoint is in progress, it aborts the checkpoint and returns
  // 0. Otherwise it returns the number of ranks, except this one, for which no RankFinished has
  // arrived (from the rank or from its sub-coordinator). Returns 0 if no rank is considered
  // unresponsive.
  std::int64_t check_unresponsive_ranks();
  // The solution. Call this once ended(), or to conclude without the unresponsive ranks.
  Solution conclude();

 private:
  using Clock = Limits::Clock;

  // Forwards events to the observer and broadcasts each new incumbent to all ranks.
  class Announcer : public ForwardingObserver {
   public:
    Announcer(RunObserver& observer, ChildLinks& children)
        : ForwardingObserver(observer), children_(children) {}
    void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;

   private:
    ChildLinks& children_;
  };

  void restore(CheckpointReader& checkpoint);
  void heard(int child, message::Status status);
  void update_checkpoints();
  void leave(const message::RankFinished& message);
  RunStatistics received_statistics() const;
  RunStatistics statistics() const;

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  Transport& transport_;
  const Hierarchy hierarchy_;
  ChildLinks children_;
  Announcer announcer_;
  NodePool pool_;  // nodes of the roots
  RankNodes nodes_;
  RunState run_;
  LoadBalancer load_balancer_;

  CheckpointTimer timer_;
  std::optional<DistributedCheckpoint> gathering_;
  bool restored_ = true;  // false: a limit was reached before all of the checkpoint was restored
  bool gathered_at_end_ = false;
  bool ending_ = false;
  Clock::time_point last_message_at_;  // when the last message of any child was handled
  // When check_unresponsive_ranks() first saw that a limit was reached.
  std::optional<Clock::time_point> stopped_at_;
  int finished_children_ = 0;
  message::RankFinished finished_;  // sum over the children that have finished
  std::map<int, RunStatistics>
      rank_statistics_;  // by rank: the latest statistics before its RankFinished
};

}  // namespace grove::detail
