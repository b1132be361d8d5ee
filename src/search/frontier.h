// SPDX-License-Identifier: MIT
// OPEN list of the forest: its live nodes, which are open or taken by a worker.
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

// Best-first queue: least bound, then fewest conflicts, then newest (depth first on plateaus). A
// taken node counts as live until complete(), so bound() is valid while any number of workers
// expand nodes. When memory is short, evict() drops nodes: bound() keeps their least bound, and
// restart() searches again from the roots. The proof is at the head of frontier.cpp. Thread-safe;
// each method holds one mutex. push() and take() find the bound in O(log(distinct bounds)) and the
// node in amortized O(log(open nodes of that bound)); methods that process many nodes hold the
// mutex until they are done. If an entry cannot be allocated, a method throws std::bad_alloc and
// the frontier loses no node that it holds: a taken node stays taken and counts in bound().
class Frontier {
 public:
  void push(NodePtr node);
  // Takes the best open node; returns nullptr if none is open. The caller must complete() or
  // reinsert() it.
  NodePtr take();
  // Like take(), but selects by estimated plan cost (EES): among the open nodes whose bound is
  // within omega of `lower_bound`, the node with the least bound + `per_conflict` * conflicts.
  // After restart(), only the newest of the nodes at the proven bound is considered. Returns
  // nullptr if there is none. O(distinct bounds within omega), besides the cost of take().
  NodePtr take_by_estimate(Omega omega, Cost lower_bound, double per_conflict);
  // Takes up to `count` open nodes for transfer to another frontier. For each bound, best first, it
  // takes about the worse half of the open nodes; with `keeps_next` it leaves the node that take()
  // would return. The caller must complete() each node once the other frontier counts it; until
  // then the node stays taken and counts in bound().
  std::vector<NodePtr> take_for_transfer(std::size_t count, bool keeps_next);
  // Completes a taken node that was pruned, transferred, or replaced by its children or its plan
  // (push the children and post the plan first).
  void complete(const NodePtr& node);
  // Returns a taken node to the open nodes, unexpanded.
  void reinsert(NodePtr node);
  // Drops every open node whose bound is at least `bound`, the cost of an incumbent, and disregards
  // evicted nodes if their least bound is that high. Returns the number of open nodes dropped.
  std::size_t prune(Cost bound);

  // Drops the worst `count` open nodes, but none of the best `keep`, and returns the dropped nodes.
  // Afterwards no live node holds their plans, so bound() includes the least of their bounds.
  std::vector<NodePtr> evict(std::size_t count, std::size_t keep = 0);
  // The least bound of the nodes that were evicted, here or elsewhere (record_evicted_bound()),
  // since the last restart and not pruned; kInfiniteCost if there is none.
  Cost evicted_bound() const;
  // Restarts the search after evictions: resets evicted_bound() and pushes `roots`, the roots of
  // all trees from which nodes were evicted. `proven` is evicted_bound() or, for several frontiers,
  // the least of their evicted bounds. Requires that no node is live and that every tree not yet
  // instantiated costs at least `proven`. From then on nodes whose bound is at most `proven` are
  // taken first, newest first.
  void restart(std::span<const NodePtr> roots, Cost proven);

  // All live nodes and the least bound of evicted nodes, taken at the same moment.
  struct Snapshot {
    std::vector<NodePtr> live;
    Cost evicted_bound = kInfiniteCost;
  };
  Snapshot snapshot() const;
  // Records that a node of bound `bound` was evicted elsewhere; bound() takes it into account.
  void record_evicted_bound(Cost bound);

  // Drops all nodes without releasing them; the frontier must not be used afterwards. Call it when
  // their pool is about to be destroyed, because releasing millions of nodes one by one takes
  // seconds.
  void abandon();

  // The least bound of all live nodes (open or taken) and evicted nodes; kInfiniteCost if there is
  // none. After restart(), a node with a lower bound counts with the bound that was proven before
  // the restart.
  Cost bound() const;
  std::size_t open() const;
  // The number of open nodes with one bound.
  struct Level {
    Cost bound = 0;
    std::int64_t open = 0;
    friend bool operator==(const Level&, const Level&) = default;
  };
  // The `max_count` least bounds of open nodes, ascending, with the number of nodes of each.
  std::vector<Level> levels(std::size_t max_count) const;
  // The number of live nodes: open or taken.
  std::size_t live() const;
  // True if no node is live and bound() includes no evicted node.
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
  std::map<Cost, std::size_t> taken_;       // number of taken nodes of each rank
  std::vector<NodePtr> in_progress_;        // the taken nodes, which are few
  Cost evicted_bound_ = kInfiniteCost;
  Cost proven_ = -1;  // bound proven before the last restart; -1 if there was no restart
  std::size_t open_count_ = 0;
  std::uint64_t serial_ = 0;
};

}  // namespace grove::detail
