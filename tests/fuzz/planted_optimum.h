// SPDX-License-Identifier: MIT
// Checks that a search never loses a given optimal plan (like the debug solutions of MIP solvers
// such as HiGHS).
#pragma once

#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/run_observer.h"
#include "model/plan.h"

namespace grove::detail::fuzz {

// Follows the nodes that hold a given optimal plan. A node holds the plan if its tree allows the
// visit orders of the plan and the plan satisfies its constraints. Until a plan of the same cost is
// found, the expansion of such a node must yield a child that holds the plan, whatever the search
// branches on or prunes. Neither these nodes nor the search as a whole may claim a bound above the
// cost of the plan. Once such a node is evicted, the search may not raise its lower bound above the
// bound of that node until it restarts, except by a proof outside the trees.
class PlantedOptimum : public RunObserver {
 public:
  // `instance` must outlive this object. `optimum` must be valid and cost-optimal.
  PlantedOptimum(const Instance& instance, Plan optimum);

  void on_event(RunEvent event, const Progress& progress) override;
  void on_outside_bound(ComponentId) override { raised_outside_trees_ = true; }
  void on_infeasible(std::string_view reason) override;
  void on_root(const NodePtr& root) override;
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override;
  void on_pruned(Cost bound) override;
  void on_evicted(const NodePtr& node) override;

  // The errors found so far, in order of occurrence.
  const std::vector<std::string>& complaints() const { return complaints_; }
  // Number of nodes so far that held the plan.
  std::size_t nodes_followed() const { return nodes_followed_; }
  // Returns whether `node` holds the plan.
  bool held_by(const Node& node) const;

 private:
  void follow(const NodePtr& node);

  const Instance& instance_;
  const Plan optimum_;
  std::vector<Path> paths_;  // as state sequences of the search
  // Addresses of the live nodes that hold the plan; not owning pointers, because they would extend
  // the lifetime of the nodes. Empty once a plan of the same cost is found, because the search may
  // then prune these nodes.
  std::unordered_set<const Node*> holding_;
  bool found_ = false;
  bool raised_outside_trees_ = false;   // the next event reports a bound from outside the trees
  Cost claimed_ = 0;                    // lower bound that the search last reported
  Cost evicted_bound_ = kInfiniteCost;  // highest bound allowed after evictions of such nodes
  std::size_t nodes_followed_ = 0;
  std::vector<std::string> complaints_;
};

// Returns whether `path` satisfies `constraints` and realizes a sequence of the class `sequences`.
bool satisfies_all(const Instance& instance, AgentIndex agent, const SequenceClass& sequences,
                   std::span<const Constraint> constraints, const Path& path);

}  // namespace grove::detail::fuzz
