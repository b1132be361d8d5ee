// SPDX-License-Identifier: MIT
// What was found out about agents, as values that mean the same in every process of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "search/dependency_table.h"
#include "search/node.h"
#include "search/packed_constraints.h"
#include "search/result_cache.h"
#include "search/subproblem_table.h"

namespace grove::detail {

// An agent with the order of visits that it has in a tree, under constraints.
struct SubproblemRecord {
  std::uint32_t tree = 0;
  AgentIndex agent = -1;
  PackedConstraints constraints;  // in canonical order

  friend bool operator==(const SubproblemRecord&, const SubproblemRecord&) = default;
};

// What one agent costs, or by how much several cost more together than each alone.
struct LearnedBound {
  std::vector<SubproblemRecord> agents;  // one or more, in ascending order of agents
  SubproblemTable::Known cost;           // of one agent,
  DependencyTable::Known excess;         // of several

  // How much there is to gain by telling it: what took long to find out, raises a bound, and comes
  // up again, as few constraints do more often than many.
  double utility() const;
};

// The trees that facts are about. Of one thread.
class TreeIndex {
 public:
  // `tree` must outlive this.
  void add(const Tree& tree);
  // Null: none here.
  const Tree* of(const AgentSequencing& order) const;
  const Tree* numbered(std::uint32_t number) const;

 private:
  std::map<const AgentSequencing*, const Tree*> by_order_;
  std::map<std::uint32_t, const Tree*> by_number_;
};

// News of `memory`, as facts; but for what is of no tree in `trees`.
std::vector<LearnedBound> facts_of(const NewEntries& news, const SharedCache& memory,
                                   const TreeIndex& trees);

// Adds a fact to what `memory` knows, unless it is of a tree that is not known here. Throws
// std::invalid_argument, and learns nothing, for what cannot be: no agent, one that is not there,
// or agents in another order.
void merge(LearnedBound fact, const TreeIndex& trees, SharedCache& memory);

}  // namespace grove::detail
