// SPDX-License-Identifier: MIT
// Why the decisions of GlobalBounds are sound, in whatever order nodes are expanded.
//
// Every plan belongs to a tree (the class of its joint sequence). In an instantiated tree it
// belongs to a live node, to an evicted or pruned node, or to a node that was replaced by children
// which together hold every plan of that node (no split loses a plan, see brancher.cpp). So at
// every moment each plan is (a) in a live or evicted node, (b) in a tree not yet instantiated, or
// (c) in a node that was pruned by an incumbent of cost at most the node's bound. A plan of kind
// (a) costs at least the least bound of these nodes, of kind (b) at least the next tree's bound, of
// kind (c) at least the incumbent. *Claim: the minimum of these three is a lower bound on every
// plan.* Each such minimum was valid when it was computed, so the largest so far is valid too.
//
// *Bounds proven outside the trees* (joint search, Lagrangian bound) hold for every plan, or for
// every plan cheaper than an incumbent that was checked here before. In both cases min(that bound,
// incumbent) is a lower bound on every plan, and so is the largest of all these minima.
//
// *Stopping* at incumbent <= (1 + w) * lower bound is the definition of w-suboptimality. If nothing
// of kind (a) or (b) is left, the bound is the incumbent itself; without an incumbent there is no
// plan at all.
//
// *New trees.* Algorithm 4 of the paper instantiates the next tree when the cost of the popped node
// exceeds (1 + w) times the cost of the last tree. This only delays trees and proves nothing; the
// proof is the lower bound above. The paper's "OPEN is empty" must mean that there is no live node
// at all, including the popped one; otherwise every instance would get an unnecessary second root.
// With w = inf only the first tree is ever instantiated (S-CBS).
#include "search/global_bounds.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "model/check.h"

namespace grove::detail {

bool GlobalBounds::post(Plan plan) {
  {
    const std::lock_guard lock(mutex_);
    if (incumbent_ && incumbent_->cost <= plan.cost) return false;
  }
  plan = checked_plan(instance_, std::move(plan));

  const std::lock_guard lock(mutex_);
  if (incumbent_ && incumbent_->cost <= plan.cost) return false;
  const Cost bound = lower_bound_locked();
  GROVE_CHECK(!incumbent_ || plan.cost < incumbent_->cost,
              "a new incumbent is cheaper than the one before");
  GROVE_CHECK(plan.cost >= bound, "no plan costs less than the proven lower bound");
  incumbent_ = std::move(plan);
  GROVE_CHECK(lower_bound_locked() >= bound, "a new incumbent does not lower the lower bound");
  return true;
}

void GlobalBounds::update(Cost node_bound, Cost next_tree_bound) {
  const std::lock_guard lock(mutex_);
  const Cost before = lower_bound_locked();
  open_bound_ = std::max(open_bound_, std::min(node_bound, next_tree_bound));
  GROVE_CHECK(lower_bound_locked() >= before, "the lower bound never falls");
}

Cost GlobalBounds::lower_bound_locked() const {
  return incumbent_ ? std::min(open_bound_, incumbent_->cost) : open_bound_;
}

Cost GlobalBounds::lower_bound() const {
  const std::lock_guard lock(mutex_);
  return lower_bound_locked();
}

std::optional<Cost> GlobalBounds::incumbent_cost() const {
  const std::lock_guard lock(mutex_);
  return incumbent_ ? std::optional(incumbent_->cost) : std::nullopt;
}

std::optional<Plan> GlobalBounds::incumbent() const {
  const std::lock_guard lock(mutex_);
  return incumbent_;
}

bool GlobalBounds::finished() const {
  const std::lock_guard lock(mutex_);
  if (open_bound_ >= kInfiniteCost) return true;
  return incumbent_ && omega_.accepts(incumbent_->cost, lower_bound_locked());
}

bool GlobalBounds::proven_infeasible() const {
  const std::lock_guard lock(mutex_);
  return !incumbent_ && open_bound_ >= kInfiniteCost;
}

bool GlobalBounds::prunes(Cost bound) const {
  const std::lock_guard lock(mutex_);
  return incumbent_ && bound >= incumbent_->cost;
}

bool GlobalBounds::needs_new_tree(Cost best_bound, std::optional<Cost> last_tree_cost) const {
  if (!last_tree_cost) return true;
  if (omega_.is_infinite()) return false;
  if (best_bound >= kInfiniteCost) return true;
  return !omega_.accepts(best_bound, *last_tree_cost);
}

}  // namespace grove::detail
