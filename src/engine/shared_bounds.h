// SPDX-License-Identifier: MIT
// The bound ledger, as those see it who expand nodes.
#pragma once

#include <optional>

#include "engine/bound_source.h"
#include "model/plan.h"
#include "primal/plan_source.h"

namespace grove::detail {

// What a run has proven and found, as far as this process knows. The ledger itself is a
// CentralBounds; where it is in another process, what was last heard of it. Methods may be called
// from any thread and do not wait.
class SharedBounds {
 public:
  SharedBounds() = default;
  SharedBounds(const SharedBounds&) = delete;
  SharedBounds& operator=(const SharedBounds&) = delete;
  virtual ~SharedBounds() = default;

  // Is there nothing left to do, or no time to do it?
  virtual bool over() const = 0;
  // Nodes that cost so much or more are of no use, for a plan that was checked costs that.
  virtual Cost cutoff() const = 0;
  // That plan if it is cheaper than `cost`.
  virtual std::optional<Plan> plan_below(Cost cost) const = 0;
  // No plan costs less.
  virtual Cost lower_bound() const = 0;

  // A plan was found.
  virtual void post(Plan plan, PlanSource source) = 0;
  // Proven beside the tree: no plan costs less, but those that cost cutoff() or more, whatever that
  // was. kInfiniteCost: there is no other.
  virtual void prove(Cost bound, BoundSource by) = 0;
  // Nodes were replaced by what they led to.
  virtual void nodes_changed() = 0;
};

}  // namespace grove::detail
