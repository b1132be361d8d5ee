// SPDX-License-Identifier: MIT
// Coordinator of some of the ranks, used when there are many ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solve.h"
#include "mpi/hierarchy_links.h"
#include "mpi/load_balancer.h"
#include "mpi/messages.h"
#include "mpi/rank_nodes.h"

namespace grove::detail {

// Merges messages from its children for its parent, distributes messages from its parent to its
// children, and balances the load among the ranks below it. To its parent it acts like a rank, to
// its children like the top coordinator. The proof that the lower bound stays valid is at the head
// of coordinator.cpp. One thread at a time.
class SubCoordinator {
 public:
  // The level-`level` coordinator, below the top, on the transport's rank. `transport` must outlive
  // this object.
  SubCoordinator(Transport& transport, const Hierarchy& hierarchy, int level, const Tuning& tuning);

  // Handles a message from a child (`from` is its rank) or from the parent. Throws
  // std::invalid_argument for a type of message that neither child nor parent sends, and for a
  // status that cannot follow the previous one.
  void handle(int from, message::Message&& message);
  // Reports changes to the parent; see ParentLink::report(). `now`: seconds since the start of the
  // run.
  void send_updates(double now);
  double next_send_time() const { return parent_.reports_at(); }

 private:
  void update(int child, message::Status&& status);
  void gathered(const message::SnapshotTaken& gathered);
  void send_finished(const message::RankFinished& message);
  void order(const message::SendNodes& order);
  void restart(const message::Restart& order);
  message::Status status() const;

  ChildLinks children_;
  RankNodes nodes_;
  LoadBalancer load_balancer_;
  ParentLink parent_;
  bool changed_ = false;                       // changed since the last status
  std::int64_t assigned_ = 0;                  // number of AssignNodes messages handled so far
  std::vector<message::BatchReceived> taken_;  // receipts not yet reported to the parent
  Cost cutoff_ = kInfiniteCost;                // cost of the incumbent
  message::SnapshotTaken gathered_;  // merged over the children that have taken a snapshot
  int snapshots_taken_ = 0;
  message::RankFinished finished_;  // sum over the children that have finished
  int finished_children_ = 0;
  bool ending_ = false;
};

}  // namespace grove::detail
