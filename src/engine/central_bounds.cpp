// SPDX-License-Identifier: MIT
// CTS-CBS (paper, Algorithms 1 and 4) among workers; the proof that it may stop is at the head of
// search/global_bounds.cpp and holds for any order of expansion. What it asks of those who share a
// search:
//
// *The ledger's two numbers*, the least bound of the live nodes and the bound of the trees not yet
// instantiated, are read while others work. A tree's root is pushed first and the bound of the
// trees after it published then; and the trees' bound is read before the nodes'. So a plan in a
// tree that was not yet instantiated when the nodes' bound was read was not either when the trees'
// was read, and any other plan is in a live node, or was pruned: the minimum of the two bounds it.
// A node is live until all that it led to has been pushed.
//
// *Nothing left* is said only when no node is live and no tree is due, while nobody else may
// instantiate one: nodes come from live nodes and from new trees alone (central_trees.cpp).
//
// *Pruning.* An incumbent is in the gate, checked, before anybody prunes by it.
#include "engine/central_bounds.h"

#include <fmt/format.h>

#include <utility>

namespace grove::detail {

std::optional<Plan> CentralBounds::plan_below(Cost cost) const {
  if (cutoff() >= cost) return std::nullopt;
  return gate_.incumbent();
}

void CentralBounds::post(Plan plan, PlanSource source) {
  const std::lock_guard lock(posting_);
  const Cost cost = plan.cost;
  const Cost before = gate_.incumbent_cost().value_or(cost);
  if (!gate_.post(std::move(plan))) return;
  count(source, before - cost);
  announcements_.incumbent(*gate_.incumbent(), source);
  nodes_.prune(cost);
  announcements_.event(RunEvent::kIncumbent);
}

void CentralBounds::count(PlanSource source, Cost gain) {
  const std::lock_guard lock(counting_);
  Found& found = found_[static_cast<std::size_t>(source)];
  ++found.plans;
  found.gain += gain;
}

void CentralBounds::nodes_changed() {
  const Cost trees = trees_from_;  // before the nodes': see above
  gate_.update(nodes_.bound(), trees);
  announcements_.bound(gate_.lower_bound());
}

void CentralBounds::prove(Cost bound, BoundSource by) {
  announcements_.bound_beside(by, [&] {
    gate_.update(bound, bound);
    return gate_.lower_bound();
  });
  if (bound >= kInfiniteCost && gate_.proven_infeasible() && !ended_beside_.exchange(true))
    announcements_.infeasible(kNoJointPlan);
}

void CentralBounds::add_counts(Stats& stats) const {
  const std::lock_guard lock(counting_);
  for (std::size_t source = 0; source < found_.size(); ++source) {
    if (found_[source].plans == 0) continue;
    stats.counts[fmt::format("plans_{}", kPlanSources[source])] += found_[source].plans;
    stats.counts[fmt::format("gain_{}", kPlanSources[source])] += found_[source].gain;
  }
}

void CentralBounds::resume_at(Cost lower_bound) {
  gate_.update(lower_bound, lower_bound);
  announcements_.bound_is_known(lower_bound);
}

}  // namespace grove::detail
