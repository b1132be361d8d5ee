// SPDX-License-Identifier: MIT
// The live nodes of the forest: open, or in the hands of a worker.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "search/node.h"

namespace grove::detail {

// Best first: least bound, among equals the one of fewest conflicts, among those the newest (which
// goes deep on plateaus). A node taken out counts as live until it is settled, so bound() is valid
// while any number of workers expand. Nodes may be given up for want of memory: bound() remembers
// the least bound among them, and restart() begins anew. Why that is sound: frontier.cpp. All
// methods may be called from any thread; each holds one mutex for O(log of the distinct bounds),
// prune() and evict() for as long as it takes to find their nodes. Where memory for an entry cannot
// be had, std::bad_alloc is thrown and no node is lost: one taken stays taken, and counts.
class Frontier {
 public:
  void push(NodePtr node);
  // The best open node; null when none is open. The caller must settle() it, or give it back.
  NodePtr take();
  // Like take(), among the open nodes whose bound is within omega of `lower_bound`: the one below
  // which the cheapest plan is expected, if each conflict costs `per_conflict`. Null when there is
  // none. O(distinct bounds within omega).
  NodePtr take_by_estimate(Omega omega, Cost lower_bound, double per_conflict);
  // Takes up to `count` nodes for another frontier, beginning with the best bound: of each bound
  // half of the open nodes, the worse ones; if `keeps_next`, not the node that take() would. Settle
  // them when they count there.
  std::vector<NodePtr> take_for_transfer(std::size_t count, bool keeps_next);
  // A taken node has been replaced by what it led to (push that first), or pruned.
  void settle(const NodePtr& node);
  // A taken node goes back unexpanded.
  void reinsert(NodePtr node);
  // Drops every open node whose bound is at least `bound`, which an incumbent costs; returns how
  // many.
  std::size_t prune(Cost bound);

  // Gives up the worst `count` open nodes but for the best `keep`, and returns them. Their
  // plans are no longer in any live node; the least of their bounds is kept in bound().
  std::vector<NodePtr> evict(std::size_t count, std::size_t keep = 0);
  // The least bound of what was given up and not pruned since; kInfiniteCost: nothing.
  Cost evicted_bound() const;
  // Forgets what was given up and pushes the roots of all the trees that it came from. Only when no
  // node is live, and after every tree not yet instantiated costs at least `proven`, which is
  // evicted_bound(), or the least of several frontiers'. Nodes below that bound are then taken
  // newest first.
  void restart(std::span<const NodePtr> roots, Cost proven);

  // All that is not settled or pruned, and the least bound of what was given up, at one moment.
  struct Snapshot {
    std::vector<NodePtr> live;
    Cost evicted_bound = kInfiniteCost;
  };
  Snapshot snapshot() const;
  // Something of this bound was given up elsewhere, and is now this frontier's to remember.
  void record_evicted_bound(Cost bound);

  // Empties the frontier without giving its nodes up, for when their pool is about to go: releasing
  // millions of nodes one by one takes seconds.
  void abandon();

  // The least bound of any live node, open or taken, and of any that was given up; kInfiniteCost
  // when there is none.
  Cost bound() const;
  std::size_t open() const;
  // How many open nodes there are of each bound; the least `most` bounds.
  struct Level {
    Cost bound = 0;
    std::int64_t open = 0;
    friend bool operator==(const Level&, const Level&) = default;
  };
  std::vector<Level> levels(std::size_t most) const;
  // Open or taken.
  std::size_t live() const;
  bool empty() const { return bound() == kInfiniteCost; }

 private:
  struct Open {
    std::uint64_t serial;
    NodePtr node;
  };

  Cost rank(const NodePtr& node) const { return std::max(node->bound(), proven_); }
  auto order_in(Cost rank) const;
  NodePtr take_locked(std::map<Cost, std::vector<Open>>::iterator best);
  void push_locked(NodePtr node);
  void release_locked(const NodePtr& node);

  mutable std::mutex mutex_;
  std::map<Cost, std::vector<Open>> open_;  // heaps, by rank
  std::map<Cost, std::size_t> taken_;       // how many nodes of each rank are in workers' hands
  std::vector<NodePtr> in_hand_;            // these; few
  Cost evicted_ = kInfiniteCost;
  Cost proven_ = -1;  // before the restart: no plan costs less; -1: there was none
  std::size_t open_count_ = 0;
  std::uint64_t serial_ = 0;
};

}  // namespace grove::detail
