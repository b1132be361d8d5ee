// SPDX-License-Identifier: MIT
// A coordinator of some of the ranks, where there are many.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solve.h"
#include "mpi/child_links.h"
#include "mpi/load_balancer.h"
#include "mpi/messages.h"
#include "mpi/parent_link.h"
#include "mpi/rank_nodes.h"

namespace grove::detail {

// Merges what is said below it on its way up, spreads what is said above it on its way down, and
// keeps those below it at work. To its superior it is like a rank, to its children like the one
// coordinator: why that is sound is told at the head of coordinator.cpp. Of one thread.
class SubCoordinator {
 public:
  // Of this level on the transport's rank; not the top one. `transport` must outlive this.
  SubCoordinator(Transport& transport, const Hierarchy& hierarchy, int level, const Tuning& tuning);

  // From a rank that is a child or has one's coordinator, or from that of the superior. Throws
  // std::invalid_argument for what neither sends.
  void handle(int from, message::Message&& message);
  // Tells the superior what is new; see Superior::report().
  void send_updates(double now);
  double next_send_time() const { return parent_.reports_at(); }

 private:
  void heard(int child, message::Status&& status);
  void gathered(const message::SnapshotTaken& gathered);
  void send_finished(const message::RankFinished& said);
  void order(const message::SendNodes& order);
  void begin_anew(const message::Restart& anew);
  message::Status status() const;

  ChildLinks children_;
  RankNodes nodes_;
  LoadBalancer load_balancer_;
  ParentLink parent_;
  bool changed_ = false;                       // since the last status
  std::int64_t assigned_ = 0;                  // how many Entrust it has obeyed
  std::vector<message::BatchReceived> taken_;  // not said yet
  Cost cutoff_ = kInfiniteCost;                // what the incumbent costs
  message::SnapshotTaken gathered_;            // of those that have looked
  int looked_ = 0;
  message::RankFinished farewell_;  // of those that have said it
  int farewells_ = 0;
  bool ending_ = false;
};

}  // namespace grove::detail
