// SPDX-License-Identifier: MIT
// Learned bounds on agents and groups, as values with the same meaning in every process of a run.
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

// A subproblem as a value: an agent, the tree that fixes its sequence class, and constraints.
struct SubproblemRecord {
  std::uint32_t tree = 0;
  AgentIndex agent = -1;
  PackedConstraints constraints;  // in canonical order

  friend bool operator==(const SubproblemRecord&, const SubproblemRecord&) = default;
};

// A lower bound on the cost of one agent, or on the excess of several agents together over the sum
// of their individual costs.
struct LearnedBound {
  std::vector<SubproblemRecord> agents;  // one or more, in ascending order of `agent`
  SubproblemTable::CostBound cost;       // if there is one agent
  DependencyTable::ExcessBound excess;   // if there are several

  // Expected benefit of sending this bound. It rises with the expansions spent on the bound, is
  // higher if the excess is positive, and falls with the size of the constraints, because
  // subproblems with few constraints recur more often.
  double utility() const;
};

// Index of the trees that learned bounds refer to. One thread at a time.
class TreeIndex {
 public:
  // `tree` must outlive this object.
  void add(const Tree& tree);
  // of(): a tree that contains `order`. numbered(): the tree with this number. Each returns nullptr
  // if the index has no such tree.
  const Tree* of(const AgentSequencing& order) const;
  const Tree* numbered(std::uint32_t number) const;

 private:
  std::map<const AgentSequencing*, const Tree*> by_order_;
  std::map<std::uint32_t, const Tree*> by_number_;
};

// Converts new entries of `memory` to learned bounds. Omits bounds that refer to a tree that is not
// in `trees`.
std::vector<LearnedBound> learned_bounds_of(const NewEntries& news, const SharedCache& memory,
                                            const TreeIndex& trees);

// Merges a learned bound into `memory`, or ignores it if one of its trees is not in `trees`. Throws
// std::invalid_argument, and merges nothing, if the bound is impossible: it has no agent, an agent
// that does not exist, agents that are not in ascending order, or a negative cost or excess.
void merge(LearnedBound fact, const TreeIndex& trees, SharedCache& memory);

}  // namespace grove::detail
