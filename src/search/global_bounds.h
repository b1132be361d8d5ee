// SPDX-License-Identifier: MIT
// Incumbent and global lower bound; tests to prune and to stop (docs/design.md, section 2).
#pragma once

#include <mutex>
#include <optional>

#include "model/instance.h"
#include "model/omega.h"
#include "model/plan.h"

namespace grove::detail {

// Holds the incumbent and the proven lower bound. Only this class decides when to stop, what to
// prune and whether a new tree is necessary; it decides in integers. The proof is at the head of
// global_bounds.cpp. Thread-safe.
class GlobalBounds {
 public:
  // `instance` must outlive this object.
  GlobalBounds(const Instance& instance, Omega omega) : instance_(instance), omega_(omega) {}

  // Offers a plan from any source: a conflict-free node, a heuristic, a file. A plan that is
  // cheaper than the incumbent is re-checked from scratch and replaces it. Returns true if it did.
  // Throws std::logic_error if the checker refuses the plan: the code that made it has a bug.
  bool post(Plan plan);

  // Updates the lower bound from `node_bound`, the least bound of the live nodes, and
  // `next_tree_bound`, a proven lower bound on every tree not yet instantiated (kInfiniteCost if
  // there is none). Both must have held at one moment.
  void update(Cost node_bound, Cost next_tree_bound);

  // Proven lower bound on the cost of every plan. Never decreases; at most the incumbent's cost.
  Cost lower_bound() const;
  std::optional<Cost> incumbent_cost() const;
  std::optional<Plan> incumbent() const;

  // Whether the incumbent is within omega of the lower bound, or no live node and no further tree
  // is left.
  bool finished() const;
  // Whether no live node and no further tree is left and there is no incumbent: there is no plan.
  bool proven_infeasible() const;
  // Whether a node of this bound cannot lead to a plan cheaper than the incumbent.
  bool prunes(Cost bound) const;
  // Algorithm 4: whether the next tree must be instantiated before a node of bound `best_bound`
  // (kInfiniteCost: no live node) is expanded. `last_tree_cost` is the cost of the joint sequence
  // instantiated last, nullopt before the first.
  bool needs_new_tree(Cost best_bound, std::optional<Cost> last_tree_cost) const;

 private:
  Cost lower_bound_locked() const;

  const Instance& instance_;
  const Omega omega_;
  mutable std::mutex mutex_;
  std::optional<Plan> incumbent_;
  Cost open_bound_ = 0;  // min(live nodes, next tree), made monotone
};

}  // namespace grove::detail
