// SPDX-License-Identifier: MIT
// Expanding a node: the one place where constraint trees grow.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grove/model/limits.h"
#include "grove/search/brancher.h"
#include "grove/search/dependencies.h"
#include "grove/search/node.h"
#include "grove/search/path_planner.h"
#include "grove/search/path_sets.h"
#include "grove/search/situations.h"
#include "grove/search/techniques.h"

namespace grove {

// What an expansion led to. If `stopped`, a limit struck: nothing else is set and the node is as it
// was. Otherwise the node's plans cheaper than the cutoff are exactly those of its children, or
// `plan` is the best of them.
struct Expansion {
  bool stopped = false;
  std::optional<Plan> plan;       // the node's paths, or others as cheap, are conflict-free
  std::vector<NodePtr> children;  // at most two; a child without a path is none. One: perhaps the
                                  // same node with a higher bound
};

// What expanders have done so far.
struct ExpansionCounts {
  std::int64_t low_level_calls = 0;
  std::int64_t low_level_expanded = 0;  // labels
  std::int64_t pair_expansions = 0;
};

// Expands nodes with the workspace of one thread and a memory of what was found out about agents,
// pairs and groups before. What it says is proven whatever the memory holds; how much it says may
// depend on it, since a pair is looked into once, with the cutoff of that moment. Engines give each
// worker its own.
class Expander {
 public:
  // `problem` and `stops` must outlive the expander; `stops` may be shared with others of the same
  // thread. `seed` breaks ties among conflicts.
  Expander(const Problem& problem, AgentStopsStore& stops, Techniques techniques,
           std::uint64_t seed);

  // `cutoff`: plans that cost so much or more are of no interest (the incumbent's cost;
  // kInfiniteCost: all are).
  Expansion expand(const NodePtr& node, Cost cutoff, const Limits& limits);

  ExpansionCounts counts() const;

  // What is remembered, in bytes (about), and the most that may be: beyond, all is forgotten.
  std::size_t memory() const {
    return situations_.bytes() + path_sets_.bytes() + dependencies_.bytes();
  }
  void limit_memory(std::size_t most);

 private:
  Plan plan(const Node& node);
  void bound_memory();

  const Problem& problem_;
  const Techniques techniques_;
  PathPlanner planner_;
  Situations situations_;
  PathSets path_sets_;
  Brancher brancher_;
  Dependencies dependencies_;
  std::vector<AgentIndex> all_;
  std::vector<Split> splits_;
  std::size_t most_memory_;
};

}  // namespace grove
