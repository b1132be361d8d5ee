// SPDX-License-Identifier: MIT
// The live nodes of a search where they are with many ranks.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <vector>

#include "engine/live_nodes.h"
#include "mpi/child_links.h"
#include "mpi/messages.h"

namespace grove::detail {

// What a coordinator knows of those below it: the latest status of each child, and what it has
// entrusted to one and is still under way. Why that bounds all plans is told at the head of
// coordinator.cpp. Of one thread.
class RankNodes : public LiveNodes {
 public:
  // `children` must outlive this.
  explicit RankNodes(ChildLinks& children);

  // A child's new status. Throws std::invalid_argument for one that it cannot send.
  void update(int child, message::Status status);

  Cost bound() const override;
  Cost evicted_bound() const override;
  bool any() const override;
  Counts counts() const override { return counts_; }
  // All that the children's statuses say of nodes and limits, as one: for a superior.
  message::Status merged() const;

  // To a child that has little to do; its tree is told to all.
  void push(const NodePtr& root) override;
  void prune(Cost /*cost*/) override {}  // each rank does, when it hears of the incumbent
  void restart(std::span<const NodePtr> roots, Cost proven) override;

  // Nodes for a child, by default the one with least to do, of trees that have been told; the bound
  // also covers what was given up.
  void assign(int child, message::AssignNodes nodes);
  void assign(message::AssignNodes nodes) { assign(idlest(), std::move(nodes)); }
  // Tells all of a tree, once.
  void tell(const Tree& tree);
  // Tells all; until a child's status is of the new era it is not known what it holds.
  void begin_anew(Cost proven);

 private:
  int idlest() const;
  void add(const message::Status& status, int sign);

  ChildLinks& children_;
  std::vector<message::Status> latest_;      // by child
  std::vector<std::deque<Cost>> under_way_;  // by child: the bounds of what was entrusted
  std::multiset<Cost> bounds_;               // of both
  std::int64_t children_with_nodes_ = 0;
  std::int64_t entrusted_under_way_ = 0;
  std::int32_t epoch_ = 0;
  std::int64_t children_of_this_era_;
  Counts counts_;
  std::set<std::uint32_t> told_;  // trees
};

}  // namespace grove::detail
