// SPDX-License-Identifier: MIT
// Live nodes of a search that are distributed over many ranks.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <vector>

#include "engine/live_nodes.h"
#include "mpi/hierarchy_links.h"
#include "mpi/messages.h"

namespace grove::detail {

// A coordinator's view of the live nodes: the latest status of each child, and the assigned nodes
// that no status has covered yet. The proof that their minimum bounds all plans is at the head of
// coordinator.cpp. One thread at a time.
class RankNodes : public LiveNodes {
 public:
  // `children` must outlive this object.
  explicit RankNodes(ChildLinks& children);

  // Handles a new status from `child`. Throws std::invalid_argument for a status that cannot follow
  // the previous one.
  void update(int child, message::Status status);

  Cost bound() const override;
  Cost evicted_bound() const override;
  bool any() const override;
  Counts counts() const override { return counts_; }
  // The statuses of all children merged into one, for the parent: only the fields about nodes,
  // proven bounds and limits.
  message::Status merged() const;

  // Assigns `root` to the least loaded child and broadcasts its tree.
  void push(const NodePtr& root) override;
  void prune(Cost /*cost*/) override {}  // each rank prunes when it receives the incumbent
  void restart(std::span<const NodePtr> roots, Cost proven) override;

  // Assigns nodes to a child, by default to the least loaded one. The trees of the nodes must have
  // been broadcast. The evicted bound in `nodes` counts as assigned, too.
  void assign(int child, message::AssignNodes nodes);
  void assign(message::AssignNodes nodes) { assign(least_loaded(), std::move(nodes)); }
  // Broadcasts a tree, unless that was done before.
  void send(const Tree& tree);
  // Broadcasts Restart. Until a child's status has the new epoch, the nodes of the child count as
  // unknown.
  void broadcast_restart(Cost proven);

 private:
  int least_loaded() const;
  void add(const message::Status& status, int sign);
  void erase_bound(Cost bound);

  ChildLinks& children_;
  std::vector<message::Status> latest_;       // by child
  std::vector<std::deque<Cost>> in_transit_;  // by child: bounds of assignments in transit
  std::multiset<Cost> bounds_;                // bounds of all latest statuses and assigned nodes
  std::int64_t children_with_nodes_ = 0;
  std::int64_t assignments_in_transit_ = 0;
  std::int32_t epoch_ = 0;
  std::int64_t children_of_this_epoch_;
  Counts counts_;
  std::set<std::uint32_t> broadcast_trees_;  // numbers of the trees broadcast
};

}  // namespace grove::detail
