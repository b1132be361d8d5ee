// SPDX-License-Identifier: MIT
// Global bounds of CTS-CBS (paper, Algorithms 1 and 4) with concurrent workers. The proof that the
// search may stop is at the head of search/global_bounds.cpp and holds for any order of expansion.
// It has three premises:
//
// (a) Lower bound. The bound is the minimum of two numbers that are read while other threads work:
//   the least bound of the live nodes, and the bound of the trees not yet instantiated. When a tree
//   is instantiated, its root is pushed first, and the bound of the later trees is published
//   afterwards. The trees' bound is read before the nodes' bound. Claim: the minimum is a lower
//   bound on every plan that was not pruned. Proof: suppose that the root of a plan's tree was not
//   pushed when the nodes' bound was read. Then the bound of the trees, read earlier, covers the
//   plan. Otherwise the plan is in a live node or was pruned, because a node is live until all its
//   children have been pushed.
//
// (b) End. The search ends for lack of nodes only when no node is live and no tree is due. This is
//   tested under the lock that excludes the instantiation of trees (central_trees.cpp). Nodes come
//   only from live nodes and from new trees, so no node can appear afterwards.
//
// (c) Pruning. No thread prunes by an incumbent before GlobalBounds has checked it.
#include "engine/central_bounds.h"

#include <utility>

namespace grove::detail {

std::optional<Plan> CentralBounds::plan_below(Cost cost) const {
  if (cutoff() >= cost) return std::nullopt;
  return global_bounds_.incumbent();
}

void CentralBounds::post(Plan plan, PlanSource source) {
  const std::lock_guard lock(posting_);
  const Cost cost = plan.cost;
  const Cost before = global_bounds_.incumbent_cost().value_or(cost);
  if (!global_bounds_.post(std::move(plan))) return;
  count(source, before - cost);
  run_events_.incumbent(*global_bounds_.incumbent(), source);
  nodes_.prune(cost);
  run_events_.event(RunEvent::kIncumbent);
}

void CentralBounds::count(PlanSource source, Cost gain) {
  const std::lock_guard lock(counting_);
  Found& found = found_[static_cast<std::size_t>(source)];
  ++found.plans;
  found.gain += gain;
}

void CentralBounds::nodes_changed() {
  const Cost trees = trees_from_;  // before the nodes' bound: see (a)
  global_bounds_.update(nodes_.bound(), trees);
  run_events_.bound(global_bounds_.lower_bound());
}

void CentralBounds::prove(Cost bound, ComponentId by) {
  run_events_.prove_outside_trees(by, [&] {
    global_bounds_.update(bound, bound);
    return global_bounds_.lower_bound();
  });
  if (bound >= kInfiniteCost && global_bounds_.proven_infeasible() &&
      !ended_outside_.exchange(true))
    run_events_.infeasible(kNoJointPlan);
}

void CentralBounds::add_counts(Counters& counters) const {
  const std::lock_guard lock(counting_);
  for (std::size_t source = 0; source < found_.size(); ++source) {
    if (found_[source].plans == 0) continue;
    counters[*counter_named("plans_", kPlanSources[source])] += found_[source].plans;
    counters[*counter_named("gain_", kPlanSources[source])] += found_[source].gain;
  }
}

void CentralBounds::resume_at(Cost lower_bound) {
  global_bounds_.update(lower_bound, lower_bound);
  run_events_.bound_is_known(lower_bound);
}

}  // namespace grove::detail
