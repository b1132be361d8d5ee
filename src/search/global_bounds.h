// SPDX-License-Identifier: MIT
// The bound ledger and every decision that rests on it (docs/design.md, section 2).
#pragma once

#include <mutex>
#include <optional>

#include "model/instance.h"
#include "model/omega.h"
#include "model/plan.h"

namespace grove::detail {

// Holds the incumbent and the proven lower bound, and alone decides - in integers - when to stop,
// what to prune and whether a new tree is necessary. The argument is at the head of gate.cpp. All
// methods may be called from any thread.
class GlobalBounds {
 public:
  // `instance` must outlive the gate.
  GlobalBounds(const Instance& instance, Omega omega) : instance_(instance), omega_(omega) {}

  // Offers a plan from anywhere: a conflict-free node, a heuristic, a file. It is re-checked from
  // scratch; kept if it is cheaper than the incumbent. True if kept. Throws std::logic_error if the
  // checker refuses it: whoever made it is broken.
  bool post(Plan plan);

  // Tells the ledger the least bound of the live nodes and a proven lower bound on every tree not
  // yet instantiated (kInfiniteCost: none). Both must have held at one moment.
  void update(Cost live_bound, Cost next_tree_bound);

  // Proven: no plan costs less. Never decreases; at most the incumbent's cost.
  Cost lower_bound() const;
  std::optional<Cost> incumbent_cost() const;
  std::optional<Plan> incumbent() const;

  // The incumbent is good enough for w, or no live node and no further tree is left.
  bool finished() const;
  // No node and no tree is left and nothing was found: there is no plan.
  bool proven_infeasible() const;
  // A node of this bound cannot lead to a plan cheaper than the incumbent.
  bool prunes(Cost bound) const;
  // Algorithm 4: must the next tree be instantiated before a node of `best_live` (kInfiniteCost: no
  // live node) is expanded? `last_tree_cost` is the cost of the last joint sequence instantiated,
  // none before the first.
  bool needs_new_tree(Cost best_live, std::optional<Cost> last_tree_cost) const;

 private:
  Cost lower_bound_locked() const;

  const Instance& instance_;
  const Omega omega_;
  mutable std::mutex mutex_;
  std::optional<Plan> incumbent_;
  Cost open_bound_ = 0;  // min(live nodes, next tree), made monotone
};

}  // namespace grove::detail
