// SPDX-License-Identifier: MIT
// The coordinator of a distributed search, on rank 0.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "engine/run_observer.h"
#include "engine/run_state.h"
#include "mpi/checkpoint_schedule.h"
#include "mpi/hierarchy_links.h"
#include "mpi/load_balancer.h"
#include "mpi/messages.h"
#include "mpi/rank_nodes.h"
#include "mpi/received_statistics.h"
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
  bool ended() const { return statistics_.finished_children() == children_.count(); }
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

  // Measures the silence of the children after a limit.
  class SilenceClock {
   public:
    explicit SilenceClock(Clock::time_point now) : last_message_at_(now) {}

    void heard(Clock::time_point now) { last_message_at_ = now; }
    // The limit counts as reached at the first call.
    void limit_is_reached(Clock::time_point now) { limit_at_ = limit_at_.value_or(now); }
    Clock::duration since_limit(Clock::time_point now) const { return now - *limit_at_; }
    // Silence before the limit does not count, because there may have been nothing to report.
    Clock::duration silence(Clock::time_point now) const {
      return now - std::max(last_message_at_, *limit_at_);
    }

   private:
    Clock::time_point last_message_at_;  // when the last message from a child was handled
    std::optional<Clock::time_point> limit_at_;
  };

  void restore(CheckpointReader& checkpoint);
  void update(int child, message::Status status);
  void leave(const message::RankFinished& message);
  RunStatistics statistics() const;

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  Transport& transport_;
  ChildLinks children_;
  Announcer announcer_;
  NodePool pool_;  // memory of the root nodes
  RankNodes nodes_;
  RunState run_;
  LoadBalancer load_balancer_;
  CheckpointSchedule checkpoints_;
  ReceivedStatistics statistics_;
  SilenceClock silence_;
  bool ending_ = false;
};

}  // namespace grove::detail
