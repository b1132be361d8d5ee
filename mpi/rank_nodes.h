// SPDX-License-Identifier: MIT
// The live nodes of a search where they are with many ranks.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "grove/engine/ledger.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove {

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
  // To a rank that has little to do; after the tree has been told to all.
  void push(const NodePtr& root) override;
  void prune(Cost /*cost*/) override {}  // each rank does, when it hears of the incumbent
  void restart(std::span<const NodePtr> roots, Cost proven) override;

  using NumberedNode = std::pair<std::int32_t, NodeRecord>;
  // Nodes for a rank, of trees numbered by number(); the bound also covers what was given up.
  void entrust(int rank, std::vector<NumberedNode> nodes, Cost evicted_bound = kInfiniteCost);
  // The number of a root's tree, which all are told if it is new.
  std::int32_t number(const NodePtr& root);
  const Tree& tree(std::int32_t number) const {
    return *trees_.at(static_cast<std::size_t>(number));
  }

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
  std::vector<const Tree*> trees_;               // that have been told
  std::map<const Tree*, std::int32_t> numbers_;  // of these
};

}  // namespace grove
