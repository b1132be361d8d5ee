// SPDX-License-Identifier: MIT
// Interface to the global bounds, for the threads that expand nodes, and sources of bounds.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "model/plan.h"
#include "primal/plan_source.h"

namespace grove::detail {

// Source of a lower bound outside the tree search. The values are used in messages.
enum class BoundSource : std::uint8_t {
  kJointSearch,  // A* over joint states
  kLagrangian,   // Lagrangian relaxation
};
inline constexpr BoundSource kLastProvenBy = BoundSource::kLagrangian;

// Name in logs.
constexpr std::string_view name_of(BoundSource by) {
  return by == BoundSource::kJointSearch ? "joint" : "lagrangian";
}

// Incumbent and lower bound of a run, as far as this process has them. CentralBounds implements it
// where the bounds are kept; in other processes an implementation stores what was last received.
// Thread-safe; no method blocks for long.
class SharedBounds {
 public:
  SharedBounds() = default;
  SharedBounds(const SharedBounds&) = delete;
  SharedBounds& operator=(const SharedBounds&) = delete;
  virtual ~SharedBounds() = default;

  // True if there is nothing left to do or a limit was reached.
  virtual bool over() const = 0;
  // Cost of the incumbent, which was checked: nodes of this bound or more need not be expanded.
  // kInfiniteCost: no incumbent.
  virtual Cost cutoff() const = 0;
  // Returns the incumbent if it costs less than `cost`, else nullopt.
  virtual std::optional<Plan> plan_below(Cost cost) const = 0;
  // Proven lower bound: no plan costs less.
  virtual Cost lower_bound() const = 0;

  // Offers a plan.
  virtual void post(Plan plan, PlanSource source) = 0;
  // Reports a bound proven outside the tree search: no plan costs less, except plans that cost at
  // least cutoff() at the time of the proof. kInfiniteCost: there is no other plan.
  virtual void prove(Cost bound, BoundSource by) = 0;
  // Call after nodes were replaced by their children.
  virtual void nodes_changed() = 0;
};

}  // namespace grove::detail
