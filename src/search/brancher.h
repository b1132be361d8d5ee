// SPDX-License-Identifier: MIT
// Branching: splits a node on one of its conflicts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/limits.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/fewest_conflicts.h"
#include "search/child_costs.h"
#include "search/node_view.h"
#include "search/path_planner.h"
#include "search/result_cache.h"
#include "search/search_options.h"

namespace grove::detail {

// The split of a node, and the conflict that it resolves.
struct Branching {
  Conflict conflict;  // of the node's paths
  Split split;
};

// Chooses the split of a node, normally by strong branching, and creates the children. The proof
// that no plan is lost is at the head of brancher.cpp. One thread at a time.
class Brancher {
 public:
  enum class Outcome : std::uint8_t {
    kBranched,
    kConflictFree,  // NodeView::paths() have no conflict, possibly after bypasses
    kStopped,       // a limit was reached, or the costs to go of an agent would become too large;
                    // there is no result
  };

  // `problem`, `planner` and `memory` must outlive this object. `planner` and `memory` may be
  // shared with other objects of the same thread.
  Brancher(const Problem& problem, const SearchOptions& options, PathPlanner& planner,
           WorkerCache& memory);

  // Splits the node that `view` has entered, unless its paths have no conflict, and appends the
  // children, at most two, to `children`. If the result is kBranched, every plan that satisfies the
  // node's constraints and costs less than `cutoff` satisfies the constraints of at least one
  // child; a child that is proven to hold no such plan is omitted. `fallback_splits` are further
  // splits that are valid at the node. Strong branching considers them in order, as long as the
  // best split so far raises the cost of no branch, and only those whose two agents are in
  // conflict.
  Outcome branch(NodeView& view, Cost cutoff, std::span<const Split> fallback_splits,
                 const Limits& limits, std::vector<NodePtr>& children);
  // The split that the last call of branch() made; nullopt if it made none.
  const std::optional<Branching>& branching() const { return branching_; }

  // Counters since construction. mdd_nodes(): MDD nodes searched for paths with the fewest
  // conflicts. splits(): splits by the kind of their second constraint, which identifies the
  // technique (kRestBy: target, kNoRestBy: cost split). child_costs(): cost queries of strong
  // branching and of re-planning.
  std::int64_t mdd_nodes() const { return fewest_conflicts_.nodes(); }
  std::span<const std::int64_t, kConstraintKinds> splits() const { return splits_made_; }
  std::int64_t bypasses() const { return bypasses_; }
  const ChildCosts& child_costs() const { return child_costs_; }

 private:
  // Result of one branch of a split.
  struct Branch {
    bool open = false;  // false: the branch holds no plan cheaper than the cutoff
    Cost increase = 0;
    int conflicts = 0;               // change in the number of conflicts
    std::vector<AgentIndex> agents;  // the re-planned agents
    std::vector<Path> paths;         // their new paths, in the same order
  };
  // The best split so far. Splits are compared by the smaller cost increase of their two branches,
  // and then by the larger one.
  struct Choice {
    std::pair<Cost, Cost> gain{-1, -1};
    Branching branching;
  };
  // Arguments of one call of branch().
  struct Task {
    NodeView& view;
    Cost slack;  // max cost increase of a child
    const Limits& limits;
  };

  void update_avoidance_table(const NodeView& view);
  // Returns false if a limit was reached.
  bool choose(const Task& task, std::span<const Split> fallback_splits, Branching& chosen);
  bool improve(Choice& choice, const Branching& by, const Task& task);
  Branching earliest(const NodeView& view);
  bool evaluate_branch(const Task& task, const AgentConstraint& constraint, Branch& side);
  bool replan(const Task& task, const AgentConstraint& constraint, Branch& side);
  bool replan_one(const Task& task, AgentIndex agent, const Constraint& more, Time cutoff,
                  bool& found);
  bool bypass(NodeView& view, const Branch& side);
  NodePtr child(const NodeView& view, const NodePtr& parent, const AgentConstraint& constraint,
                const Branch& side) const;

  const Problem& problem_;
  const SearchOptions options_;
  PathPlanner& planner_;
  WorkerCache& memory_;
  ChildCosts child_costs_;
  FewestConflicts fewest_conflicts_;
  ConflictAvoidanceTable avoidance_table_;  // holds the paths in scope
  std::vector<Path> table_paths_;           // the paths in avoidance_table_, by AgentIndex

  std::vector<Split> splits_;
  std::array<Branch, 2> branches_;
  Path path_;
  std::optional<Branching> branching_;
  std::array<std::int64_t, kConstraintKinds> splits_made_{};
  std::int64_t bypasses_ = 0;
};

}  // namespace grove::detail
