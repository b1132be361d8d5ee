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

// Holds the global bounds, checks plans, distributes trees and nodes, balances the load and ends
// the run. Runs on rank 0 and uses that rank's transport. The protocol and the proof of the lower
// bound are at the head of coordinator.cpp. One thread at a time.
class Coordinator {
 public:
  // All arguments must outlive this object.
  Coordinator(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport);

  // Posts the start plan and instantiates the first tree, or restores a checkpoint. Must be called
  // before any other function. Throws what reading the checkpoint throws.
  void begin();
  // Handles a message from a child. Throws std::invalid_argument for a type of message that no
  // child sends and for a status that cannot follow the previous one, and what GlobalBounds::post()
  // throws.
  void handle(int from, message::Message&& message);
  // Starts a due checkpoint. If no checkpoint is in progress, ends the run if it is over, supplies
  // nodes if none is live, or prepares the next tree. Must be called repeatedly.
  void step();

  Cost lower_bound() { return run_.shared_bounds().lower_bound(); }
  // True if every child has sent RankFinished.
  bool ended() const { return finished_children_ == children_.count(); }
  // Returns the number of unresponsive ranks. A rank other than this one is unresponsive if a limit
  // was reached, no message has arrived at the coordinator for too long since then, and no
  // RankFinished has arrived for the rank (from the rank itself or from its sub-coordinator). If a
  // checkpoint is in progress at that time, aborts the checkpoint and returns 0.
  std::int64_t check_unresponsive_ranks();
  // Returns the solution. Must be called only once ended() is true, or to conclude without the
  // unresponsive ranks.
  Solution conclude();

 private:
  using Clock = Limits::Clock;

  // Forwards events to the observer, and broadcasts each new incumbent to all ranks.
  class Announcer : public ForwardingObserver {
   public:
    Announcer(RunObserver& observer, ChildLinks& children)
        : ForwardingObserver(observer), children_(children) {}
    void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;

   private:
    ChildLinks& children_;
  };

  void restore(CheckpointReader& checkpoint);
  void update(int child, message::Status status);
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
  NodePool pool_;  // memory of the root nodes
  RankNodes nodes_;
  RunState run_;
  LoadBalancer load_balancer_;

  CheckpointTimer timer_;
  std::optional<DistributedCheckpoint> gathering_;
  bool restored_ = true;  // false: a limit was reached before the checkpoint was fully restored
  bool gathered_at_end_ = false;
  bool ending_ = false;
  Clock::time_point last_message_at_;  // when the last message from a child was handled
  // When check_unresponsive_ranks() first saw that a limit was reached.
  std::optional<Clock::time_point> stopped_at_;
  int finished_children_ = 0;
  message::RankFinished finished_;  // sum over the children that have finished
  std::map<int, RunStatistics>
      rank_statistics_;  // by rank: the latest statistics before its RankFinished
};

}  // namespace grove::detail
