// SPDX-License-Identifier: MIT
// A rank's copy of the global bounds of a distributed search.
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/shared_bounds.h"
#include "model/limits.h"
#include "search/frontier.h"

namespace grove::detail {

// Stores the latest bounds received from the coordinator, and the plans and bounds to be sent to
// it. The functions of SharedBounds are thread-safe. Only the communicating thread may call the
// others.
class RemoteBounds : public SharedBounds {
 public:
  struct Found {
    Plan plan;
    PlanSource source{};
  };

  // Both arguments must outlive this object.
  RemoteBounds(const Limits& limits, const Frontier& frontier)
      : limits_(limits), frontier_(frontier) {}

  bool over() const override { return over_ || limits_.stop_requested(); }
  Cost cutoff() const override { return cutoff_; }
  std::optional<Plan> plan_below(Cost cost) const override;
  // The minimum of the bound of the whole search (infinite while unknown) and the bound of the
  // local nodes. The latter alone suffices to choose among the local nodes.
  Cost lower_bound() const override { return std::min(known_.load(), frontier_.bound()); }
  // Stores the plan, to be sent, if it is better than the plan stored so far or, if none is stored,
  // than the incumbent. No worker prunes by it before rank 0 has checked it.
  void post(Plan plan, PlanSource source) override;
  void prove(Cost bound, ComponentId by) override;
  void nodes_changed() override {}

  // Returns the best plan posted since the last call, or nullopt if no plan posted since then was
  // better than the incumbent at that time.
  std::optional<Found> take_found();
  // The best bound that this rank has proven outside the tree search, and its source.
  std::pair<Cost, ComponentId> proven() const;
  // Sets the lower bound of the whole search.
  void set_lower_bound(Cost bound) { known_ = bound; }
  // Makes a checked plan the incumbent if it is better than the current one.
  void adopt(Plan plan);
  // Ends the run: over() returns true from now on, and the workers abort their work items.
  void end();

 private:
  const Limits& limits_;
  const Frontier& frontier_;
  std::atomic<bool> over_{false};
  std::atomic<Cost> cutoff_{kInfiniteCost};
  std::atomic<Cost> known_{kInfiniteCost};
  mutable std::mutex mutex_;
  std::optional<Plan> incumbent_;  // incumbent_, found_ and proven_ are guarded by mutex_
  std::optional<Found> found_;
  std::pair<Cost, ComponentId> proven_{0, ComponentId{}};
};

}  // namespace grove::detail
