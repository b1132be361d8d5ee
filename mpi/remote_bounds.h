// SPDX-License-Identifier: MIT
// The ledger where it is in another process.
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

// What was last heard of the ledger, and the plans that it has yet to hear of. What workers ask may
// be asked from any thread; the rest is for the thread that speaks for this rank.
class RemoteBounds : public SharedBounds {
 public:
  struct Found {
    Plan plan;
    PlanSource source{};
  };

  // Both must outlive this.
  RemoteBounds(const Limits& limits, const Frontier& frontier)
      : limits_(limits), frontier_(frontier) {}

  bool over() const override { return over_ || limits_.stop_requested(); }
  Cost cutoff() const override { return cutoff_; }
  std::optional<Plan> plan_below(Cost cost) const override;
  // Where that of the whole search is not known, that of the nodes here will do to choose among
  // them.
  Cost lower_bound() const override { return std::min(known_.load(), frontier_.bound()); }
  // Nobody prunes by the plan before it has been checked.
  void post(Plan plan, PlanSource source) override;
  void prove(Cost bound, BoundSource by) override;
  void nodes_changed() override {}

  // The best plan posted since, if it is of use.
  std::optional<Found> take_found();
  // What was proven beside the nodes, and by whom.
  std::pair<Cost, BoundSource> proven() const;
  // No plan of the whole search costs less.
  void know(Cost bound) { known_ = bound; }
  // A plan that has been checked.
  void adopt(Plan plan);
  // The run is over.
  void end();

 private:
  const Limits& limits_;
  const Frontier& frontier_;
  std::atomic<bool> over_{false};
  std::atomic<Cost> cutoff_{kInfiniteCost};
  std::atomic<Cost> known_{kInfiniteCost};
  mutable std::mutex mutex_;
  std::optional<Plan> incumbent_;  // under mutex_, as is found_
  std::optional<Found> found_;
  std::pair<Cost, BoundSource> proven_{0, BoundSource::kJointSearch};
};

}  // namespace grove::detail
