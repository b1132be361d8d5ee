// SPDX-License-Identifier: MIT
// The live nodes of a search where they are with many ranks.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <vector>

#include "grove/detail/engine/live_nodes.h"
#include "grove/detail/engine/survey.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// What the coordinator knows of them: the latest status of each rank, and what it has
// entrusted to one and is still under way. Why that bounds all plans is told at the head of
// coordinator.cpp. Of one thread.
class RankNodes : public LiveNodes {
 public:
  // `transport` must outlive this.
  explicit RankNodes(Transport& transport);

  // A rank's new status. Throws std::invalid_argument for one that no rank can send.
  void update(int rank, message::Status status);

  Cost bound() const override;
  Cost evicted_bound() const override;
  bool any() const override;
  Counts counts() const override { return counts_; }
  // What the latest status of a rank says of its nodes.
  RankSurvey survey(int rank) const;
  // To a rank that has little to do; its tree is told to all.
  void push(const NodePtr& root) override;
  void prune(Cost /*cost*/) override {}  // each rank does, when it hears of the incumbent
  void restart(std::span<const NodePtr> roots, Cost proven) override;

  // Nodes for a rank, of trees that have been told; the bound also covers what was given up.
  void entrust(int rank, std::vector<NodeRecord> nodes, Cost evicted_bound = kInfiniteCost);
  // Tells all of a tree, once.
  void tell(const Tree& tree);

 private:
  int idlest() const;
  void add(const message::Status& status, int sign);

  Transport& transport_;
  std::vector<message::Status> latest_;      // by rank
  std::vector<std::deque<Cost>> under_way_;  // by rank: the bounds of what was entrusted
  std::multiset<Cost> bounds_;               // of both
  std::int64_t ranks_with_nodes_ = 0;
  std::int64_t entrusted_under_way_ = 0;
  std::int32_t era_ = 0;
  std::int64_t ranks_of_this_era_;
  Counts counts_;
  std::set<std::uint32_t> told_;  // trees
};

}  // namespace grove::detail
