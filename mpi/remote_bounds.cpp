// SPDX-License-Identifier: MIT
#include "mpi/remote_bounds.h"

#include "model/assert.h"

namespace grove::detail {

std::optional<Plan> RemoteBounds::plan_below(Cost cost) const {
  if (cutoff_ >= cost) return std::nullopt;
  const std::lock_guard lock(mutex_);
  GROVE_CHECK(incumbent_ && incumbent_->cost < cost, "the cutoff is the cost of the incumbent");
  return incumbent_;
}

void RemoteBounds::post(Plan plan, PlanSource source) {
  const std::lock_guard lock(mutex_);
  const Cost best = found_ ? found_->plan.cost : cutoff_.load();
  if (plan.cost < best) found_ = Found{std::move(plan), source};
}

std::optional<RemoteBounds::Found> RemoteBounds::take_found() {
  const std::lock_guard lock(mutex_);
  return std::exchange(found_, std::nullopt);
}

void RemoteBounds::adopt(Plan plan) {
  const std::lock_guard lock(mutex_);
  if (plan.cost >= cutoff_) return;
  const Cost cost = plan.cost;
  GROVE_CHECK(!incumbent_ || cost < incumbent_->cost, "the cost of the incumbent falls");
  incumbent_ = std::move(plan);
  cutoff_ = cost;
}

void RemoteBounds::end() {
  over_ = true;
  limits_.cancel_workers();
}

void RemoteBounds::prove(Cost bound, ComponentId by) {
  const std::lock_guard lock(mutex_);
  if (bound > proven_.first) proven_ = {bound, by};
}

std::pair<Cost, ComponentId> RemoteBounds::proven() const {
  const std::lock_guard lock(mutex_);
  return proven_;
}

}  // namespace grove::detail
