// SPDX-License-Identifier: MIT
// Watches a search through the eyes of an optimal plan (as HiGHS does with planted solutions).
#pragma once

#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/run_observer.h"
#include "model/plan.h"

namespace grove::detail::fuzz {

// Follows the nodes that hold a given optimal plan: those whose tree allows its orders of visits
// and whose constraints it obeys. From the first root that holds it on, some live node must,
// whatever is branched, pruned or forbidden, until a plan as cheap is found; and none of them, nor
// the search as a whole, may claim a bound above its cost. If the last of them is given up for want
// of memory, the search may claim no more than its bound until it restarts.
class PlantedOptimum : public RunObserver {
 public:
  // `instance` must outlive this. `optimum` must be valid and cost-optimal.
  PlantedOptimum(const Instance& instance, Plan optimum);

  void on_event(RunEvent event, const Progress& progress) override;
  void on_bound_beside(BoundSource) override { raised_beside_ = true; }
  void on_infeasible(std::string_view reason) override;
  void on_root(const NodePtr& root) override;
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override;
  void on_pruned(Cost bound) override;
  void on_evicted(const NodePtr& node) override;

  // What went wrong, in the order in which it did; empty: nothing.
  const std::vector<std::string>& complaints() const { return complaints_; }
  // Nodes so far that held the plan.
  std::size_t nodes_followed() const { return nodes_followed_; }
  // Does `node` hold the plan?
  bool held_by(const Node& node) const;

 private:
  void follow(const NodePtr& node);

  const Instance& instance_;
  const Plan optimum_;
  std::vector<Path> paths_;  // as the search walks them
  // Live nodes that hold the plan; by address, for the nodes do not outlive the search. Nothing is
  // followed any more once a plan as cheap is found: from then on the gate may drop them.
  std::unordered_set<const Node*> holding_;
  bool found_ = false;
  bool raised_beside_ = false;          // the bound, if it rises now
  Cost claimed_ = 0;                    // the search's lower bound
  Cost evicted_bound_ = kInfiniteCost;  // of the nodes given up that held the plan
  std::size_t nodes_followed_ = 0;
  std::vector<std::string> complaints_;
};

// Does `path` realize a sequence of the class, and do it and that sequence obey the constraints?
bool satisfies_all(const Instance& instance, AgentIndex agent, const SequenceClass& sequences,
                   std::span<const Constraint> constraints, const Path& path);

}  // namespace grove::detail::fuzz
