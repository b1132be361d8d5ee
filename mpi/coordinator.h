// SPDX-License-Identifier: MIT
// The head of a distributed search.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "engine/run_observer.h"
#include "engine/run_state.h"
#include "mpi/child_links.h"
#include "mpi/distributed_checkpoint.h"
#include "mpi/load_balancer.h"
#include "mpi/messages.h"
#include "mpi/rank_nodes.h"
#include "mpi/transport.h"
#include "search/node_pool.h"

namespace grove::detail {

// Holds the ledger, checks plans, brings trees, keeps ranks at work and ends the run. On rank 0, by
// whose transport it speaks. The protocol and why it is sound: coordinator.cpp. Of one thread.
class Coordinator {
 public:
  // All must outlive this.
  Coordinator(const Problem& problem, const SolveOptions& options, const Limits& limits,
              RunObserver& observer, Transport& transport);

  // Before all else: the plan to start from, and the first tree; or all that a checkpoint knows.
  // Throws as reading one does.
  void begin();
  // What one of those below has said. Throws std::invalid_argument for what none can say, and what
  // Gate::post() throws.
  void handle(int from, message::Message&& message);
  // Looks at the limits; to be called now and then.
  void step();

  Cost lower_bound() { return run_.ledger().lower_bound(); }
  // Have all ranks said farewell?
  bool ended() const { return farewells_ == children_.count(); }
  // If a limit has struck, and somebody who is waited for has said nothing for too long since then:
  // gives up a checkpoint that was being made; if there was none, says how many ranks but this one
  // have not said farewell, themselves or by who speaks for them. Else 0.
  std::int64_t check_unresponsive_ranks();
  // When ended(), or without those ranks: the answer.
  Solution conclude();

 private:
  using Clock = Limits::Clock;

  // Passes on better plans to all.
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
  void look_after_checkpoints();
  void leave(const message::RankFinished& said);
  RunStatistics told() const;
  RunStatistics survey() const;

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  Transport& transport_;
  const Hierarchy hierarchy_;
  ChildLinks children_;
  Announcer announcer_;
  NodePool pool_;  // of the roots
  RankNodes nodes_;
  RunState run_;
  LoadBalancer load_balancer_;

  CheckpointTimer timer_;
  std::optional<DistributedCheckpoint> gathering_;
  bool restored_ = true;  // nothing of a checkpoint is missing
  bool gathered_at_end_ = false;
  bool ending_ = false;
  Clock::time_point heard_at_;                   // anybody, last
  std::optional<Clock::time_point> stopped_at_;  // when a limit was first seen to have struck
  int farewells_ = 0;
  message::RankFinished farewell_;        // of those that have said it
  std::map<int, RunStatistics> surveys_;  // by rank, before the farewells; the last one
};

}  // namespace grove::detail
