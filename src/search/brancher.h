// SPDX-License-Identifier: MIT
// Splitting a node on one of its conflicts.
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

// How a node was split, and what for.
struct Branching {
  Conflict conflict;  // of the node's paths
  Split split;
};

// Chooses the split of a node and makes its children. The essay is at the head of brancher.cpp.
// Workspace of one thread.
class Brancher {
 public:
  enum class Outcome : std::uint8_t {
    kBranched,
    kConflictFree,  // of the scope, as they are at the node or after going round each other for
                    // free: see NodeView::path()
    kStopped,       // a limit struck: nothing is known
  };

  // All must outlive this; `planner` and `memory` may be shared with others of the same thread.
  Brancher(const Problem& problem, const SearchOptions& options, PathPlanner& planner,
           WorkerCache& memory);

  // Makes the children of the node that `view` has entered, appended to `children`: every plan that
  // obeys the node's constraints and costs less than `cutoff` obeys those of one of them. At most
  // two; a child that surely holds no such plan is none. `fallback_splits` are further splits,
  // valid at the node: one is made where no conflict offers any that raises the cost of a side, and
  // its two agents are in conflict.
  Outcome branch(NodeView& view, Cost cutoff, std::span<const Split> fallback_splits,
                 const Limits& limits, std::vector<NodePtr>& children);
  // How the last node was split; none if it was not.
  const std::optional<Branching>& branching() const { return branching_; }

  // So far: nodes of sets of paths looked through for those of fewest conflicts; splits made, by
  // the kind of their second demand, which tells where they come from (kRestBy: when an agent comes
  // to rest, kNoRestBy: costs); sides taken for the node's own paths; prices.
  std::int64_t optimal_nodes() const { return fewest_conflicts_.nodes(); }
  std::span<const std::int64_t, kConstraintKinds> splits() const { return splits_made_; }
  std::int64_t bypasses() const { return bypasses_; }
  const ChildCosts& prices() const { return prices_; }

 private:
  // What one side of a split leads to.
  struct Branch {
    bool open = false;  // else it holds no plan cheaper than the cutoff
    Cost increase = 0;
    int conflicts = 0;               // more than before
    std::vector<AgentIndex> agents;  // who goes another way ...
    std::vector<Path> paths;         // ... and which
  };
  // The best split so far, by what its cheaper and its dearer side rise by.
  struct Choice {
    std::pair<Cost, Cost> gain{-1, -1};
    Branching branching;
  };
  // What all steps of one call of branch() read.
  struct Task {
    NodeView& view;
    Cost slack;  // a child's cost may rise by so much
    const Limits& limits;
  };

  void show_others(const NodeView& view);
  // False: a limit struck.
  bool choose(const Task& task, std::span<const Split> fallback_splits, Branching& chosen);
  bool improve(Choice& choice, const Branching& by, const Task& task);
  bool improve_by_sequences(Choice& choice, const Task& task);
  Branching earliest(const NodeView& view);
  bool evaluate_branch(const Task& task, const AgentConstraint& demand, Branch& side);
  bool replan(const Task& task, const AgentConstraint& demand, Branch& side);
  bool replan_one(const Task& task, AgentIndex agent, const Constraint& more, Time cutoff,
                  bool& found);
  bool bypass(NodeView& view, const Branch& side);
  NodePtr child(const NodeView& view, const NodePtr& parent, const AgentConstraint& demand,
                const Branch& side) const;

  const Problem& problem_;
  const SearchOptions options_;
  PathPlanner& planner_;
  WorkerCache& memory_;
  ChildCosts prices_;
  FewestConflicts fewest_conflicts_;
  ConflictAvoidanceTable others_;  // the paths in scope
  std::vector<Path> shown_;        // what others_ holds, by AgentIndex

  std::vector<Split> splits_;
  std::array<Branch, 2> branches_;
  std::vector<AgentIndex> in_conflict_;
  Path path_;
  std::optional<Branching> branching_;
  std::array<std::int64_t, kConstraintKinds> splits_made_{};
  std::int64_t bypasses_ = 0;
};

}  // namespace grove::detail
