// SPDX-License-Identifier: MIT
// Incumbent and global lower bound, and the tests to prune and to stop (docs/design.md, section 2).
#pragma once

#include <mutex>
#include <optional>

#include "model/instance.h"
#include "model/omega.h"
#include "model/plan.h"

namespace grove::detail {

// Holds the incumbent and the proven lower bound. Only this class decides when to stop, which nodes
// to prune and whether a new tree is necessary; it decides in integer arithmetic. The proof is at
// the head of global_bounds.cpp. Thread-safe.
class GlobalBounds {
 public:
  // `instance` must outlive this object.
  GlobalBounds(const Instance& instance, Omega omega) : instance_(instance), omega_(omega) {}

  // Offers a plan from any source: a conflict-free node, a heuristic, a file. If there is no
  // incumbent or the plan is cheaper, the plan is re-checked from scratch. It then becomes the
  // incumbent, unless another thread has posted a plan of at most its cost in the meantime. Returns
  // whether it did. Throws std::logic_error if the checker refuses the plan, because then the code
  // that made it has a bug.
  bool post(Plan plan);

  // Updates the lower bound from `node_bound`, the least bound of all live and evicted nodes
  // (Frontier::bound()), and `next_tree_bound`, a proven lower bound on every tree not yet
  // instantiated (kInfiniteCost if there is none). Both must have held at the same moment. To add a
  // bound that was proven on all plans, pass it as both arguments.
  void update(Cost node_bound, Cost next_tree_bound);

  // Proven lower bound on the cost of every plan. Never decreases; at most the incumbent's cost.
  Cost lower_bound() const;
  std::optional<Cost> incumbent_cost() const;
  std::optional<Plan> incumbent() const;

  // True if the incumbent is within omega of the lower bound, or if no node (live or evicted) and
  // no further tree is left.
  bool finished() const;
  // True if there is no incumbent and no node (live or evicted) or further tree is left, which
  // proves that there is no plan.
  bool proven_infeasible() const;
  // True if a node with this bound cannot lead to a plan cheaper than the incumbent.
  bool prunes(Cost bound) const;
  // Returns whether the next tree must be instantiated before a node is expanded (Algorithm 4 of
  // the paper). `best_bound` is the least bound of all live and evicted nodes (Frontier::bound());
  // kInfiniteCost: there is none. `last_tree_cost` is the cost of the joint sequence instantiated
  // last; nullopt: no tree is instantiated yet.
  bool needs_new_tree(Cost best_bound, std::optional<Cost> last_tree_cost) const;

 private:
  Cost lower_bound_locked() const;

  const Instance& instance_;
  const Omega omega_;
  mutable std::mutex mutex_;
  std::optional<Plan> incumbent_;
  Cost open_bound_ = 0;  // the largest min(node_bound, next_tree_bound) so far
};

}  // namespace grove::detail
