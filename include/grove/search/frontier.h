// SPDX-License-Identifier: MIT
// The live nodes of the forest: open, or in the hands of a worker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "grove/search/node.h"

namespace grove {

// Best first: least bound, among equals the one of fewest conflicts, among those the newest (which
// goes deep on plateaus). A node taken out
// counts as live until it is settled, so bound() is valid while any number of workers expand. All
// methods may be called from any thread; each holds one mutex for O(log of the distinct bounds).
class Frontier {
 public:
  void push(NodePtr node);
  // The best open node; null when none is open. The caller must settle() it, or give it back.
  NodePtr take();
  // A taken node has been replaced by what it led to (push that first), or pruned.
  void settle(const NodePtr& node);
  // A taken node goes back unexpanded.
  void give_back(NodePtr node);
  // Drops every open node whose bound is at least `bound`; returns how many.
  std::size_t prune(Cost bound);

  // Empties the frontier without giving its nodes up, for when their pool is about to go: releasing
  // millions of nodes one by one takes seconds.
  void abandon();

  // The least bound of any live node, open or taken; kInfiniteCost when there is none.
  Cost bound() const;
  std::size_t open() const;
  bool empty() const { return bound() == kInfiniteCost; }

 private:
  struct Open {
    std::uint64_t serial;
    NodePtr node;
  };
  static bool later(const Open& a, const Open& b);

  void push_locked(NodePtr node);
  void release_locked(Cost bound);

  mutable std::mutex mutex_;
  std::map<Cost, std::vector<Open>> open_;  // heaps
  std::map<Cost, std::size_t> taken_;       // how many nodes of each bound are in workers' hands
  std::size_t open_count_ = 0;
  std::uint64_t serial_ = 0;
};

}  // namespace grove
