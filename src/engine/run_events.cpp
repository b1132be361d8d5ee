// SPDX-License-Identifier: MIT
#include "engine/run_events.h"

namespace grove::detail {

void RunEvents::expanded(const NodePtr& node, const Expansion& expansion, int worker) {
  const std::lock_guard lock(mutex_);
  observer_.on_expanded(node, expansion, worker);
}

void RunEvents::evicted(std::span<const NodePtr> nodes) {
  const std::lock_guard lock(mutex_);
  for (const NodePtr& node : nodes) observer_.on_evicted(node);
}

void RunEvents::event(RunEvent event) {
  const std::lock_guard lock(mutex_);
  notify(event, progress_());
}

void RunEvents::notify(RunEvent event, const Progress& progress) {
  observer_.on_event(event, progress);
  if (statistics_source_ && observer_.wants_statistics())
    observer_.on_statistics(statistics_source_());
}

void RunEvents::bound(Cost lower_bound) {
  const std::lock_guard lock(mutex_);
  bound_locked(lower_bound);
}

void RunEvents::prove_outside_trees(ComponentId by, const std::function<Cost()>& prove) {
  const std::lock_guard lock(mutex_);
  const Cost lower_bound = prove();
  if (lower_bound > announced_bound_) observer_.on_outside_bound(by);
  bound_locked(lower_bound);
}

void RunEvents::infeasible(std::string_view reason) {
  const std::lock_guard lock(mutex_);
  observer_.on_infeasible(reason);
}

// Does not report an infinite bound (no plan exists); that is reported at the end of the run.
void RunEvents::bound_locked(Cost lower_bound) {
  if (lower_bound <= announced_bound_ || lower_bound >= kInfiniteCost) return;
  const Progress progress = progress_();
  announced_bound_ = progress.lower_bound;
  notify(RunEvent::kBound, progress);
}

void RunEvents::incumbent(const Plan& plan, PlanSource source) {
  const std::lock_guard lock(mutex_);
  observer_.on_pruned(plan.cost);
  observer_.on_incumbent(plan, source, progress_());
}

void RunEvents::root(const NodePtr& root) {
  const std::lock_guard lock(mutex_);
  observer_.on_root(root);
}

void RunEvents::checkpoint(const CheckpointReport& report) {
  const std::lock_guard lock(mutex_);
  observer_.on_checkpoint(report);
}

}  // namespace grove::detail
