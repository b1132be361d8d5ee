// SPDX-License-Identifier: MIT
// Interface through which components use the global bounds.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/component_id.h"
#include "model/plan.h"
#include "primal/plan_source.h"

namespace grove::detail {

// Incumbent and lower bound of a run, as known in this process. CentralBounds implements the
// interface in the process that holds the bounds; the implementation in other processes stores the
// bounds received last. Thread-safe. No function blocks for long.
class SharedBounds {
 public:
  SharedBounds() = default;
  SharedBounds(const SharedBounds&) = delete;
  SharedBounds& operator=(const SharedBounds&) = delete;
  virtual ~SharedBounds() = default;

  // True if the run is complete or a limit was reached.
  virtual bool over() const = 0;
  // Cost of the incumbent, which has been checked. Nodes with this bound or a higher one need not
  // be expanded. kInfiniteCost: no incumbent.
  virtual Cost cutoff() const = 0;
  // Returns the incumbent if it costs less than `cost`, else nullopt.
  virtual std::optional<Plan> plan_below(Cost cost) const = 0;
  // Proven lower bound: no plan costs less. In a process that does not know the bound of the run,
  // it bounds only the plans in the nodes of that process.
  virtual Cost lower_bound() const = 0;

  // Offers a plan. If it is better than the incumbent, it is checked and becomes the incumbent. In
  // the process that holds the bounds, throws std::logic_error if the checker refuses the plan.
  virtual void post(Plan plan, PlanSource source) = 0;
  // Reports a lower bound proven outside the tree search on all plans that cost less than cutoff()
  // at the time of the proof. kInfiniteCost: no such plan exists.
  virtual void prove(Cost bound, ComponentId by) = 0;
  // Must be called after a node was replaced by its children.
  virtual void nodes_changed() = 0;
};

}  // namespace grove::detail
