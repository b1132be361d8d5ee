// SPDX-License-Identifier: MIT
// Expanding a node: the one place where constraint trees grow.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grove/conflicts/conflict.h"
#include "grove/model/limits.h"
#include "grove/planning/conflict_avoidance_table.h"
#include "grove/search/node.h"
#include "grove/search/path_planner.h"

namespace grove {

// What an expansion led to. If `stopped`, a limit struck: nothing else is set and the node is as it
// was. Otherwise the node's plans are exactly those of its children, or `plan` is the best of them.
struct Expansion {
  bool stopped = false;
  std::optional<Plan> plan;       // the node's paths were conflict-free
  std::vector<NodePtr> children;  // at most two; a child without a path is none
  std::int64_t low_level_calls = 0;
};

// A pure function of (problem, node) with the workspace of one thread. Engines give each worker its
// own; all of them compute the same.
class Expander {
 public:
  // `problem` must outlive the expander. `seed` breaks ties among conflicts.
  Expander(const Problem& problem, std::uint64_t seed);

  Expansion expand(const NodePtr& node, const Limits& limits);

  // Labels expanded by the low level so far.
  std::int64_t low_level_expanded() const { return planner_.expanded(); }

 private:
  Plan plan(const Node& node);
  void show_others();
  bool branch(const NodePtr& node, const AgentConstraint& added, const Limits& limits,
              Expansion& expansion);

  const Problem& problem_;
  ConflictFinder conflicts_;
  ConflictAvoidanceTable others_;
  PathPlanner planner_;
  std::vector<Path> paths_;
  std::vector<Path> shown_;  // what others_ holds, by AgentIndex
  std::vector<Constraint> constraints_;
  Path path_;
};

}  // namespace grove
