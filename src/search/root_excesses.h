// SPDX-License-Identifier: MIT
// Statements about the costs of groups of agents at the root of a tree.
#pragma once

#include <span>
#include <vector>

#include "search/covering.h"
#include "search/node.h"
#include "search/result_cache.h"

namespace grove::detail {

// The statements about groups of agents in a cache that hold at the root of a tree, where no agent
// has a constraint. They hold for all plans of the tree. One thread at a time.
class RootExcesses {
 public:
  // All arguments must outlive this object.
  RootExcesses(SharedCache& cache, const Tree& tree);

  // All statements with a positive excess, one for each group.
  std::vector<GroupExcess> all() const;
  // Adds proven statements to the cache. The agents of each are in ascending order.
  void add(std::span<const GroupExcess> excesses);

 private:
  SharedCache& cache_;
  std::vector<SubproblemTable::Id> subproblems_;  // by AgentIndex
};

}  // namespace grove::detail
