// SPDX-License-Identifier: MIT
// What a run tells its observer.
#pragma once

#include <functional>
#include <mutex>
#include <string_view>
#include <utility>

#include "engine/run_observer.h"
#include "engine/work_observer.h"

namespace grove::detail {

// Tells one thing at a time, with where the run stands at that moment. Methods may be called from
// any thread.
class RunEvents : public WorkObserver {
 public:
  // `observer`, and what `progress` looks at, must outlive this.
  RunEvents(RunObserver& observer, std::function<Progress()> progress)
      : observer_(observer), progress_(std::move(progress)) {}
  // How to make a survey, from any thread, for an observer that wants one. Before the search.
  void survey_by(std::function<RunStatistics()> survey) { survey_ = std::move(survey); }

  void expanded(const NodePtr& node, const Expansion& expansion, int worker) override;
  void evicted(std::span<const NodePtr> nodes) override;
  void worked() override { event(RunEvent::kProgress); }

  void event(RunEvent event);
  // The lower bound is so high now; perhaps it was before, too.
  void bound(Cost lower_bound);
  // What `prove` does makes it as high as it returns, beside the tree. Nothing else is told in
  // between.
  void bound_beside(BoundSource by, const std::function<Cost()>& prove);
  void infeasible(std::string_view reason);
  // The observer knows that it is so high.
  void bound_is_known(Cost lower_bound) { announced_bound_ = lower_bound; }
  // Dearer nodes are about to be dropped.
  void incumbent(const Plan& plan, PlanSource source);
  void root(const NodePtr& root);
  void checkpoint(const CheckpointReport& report);

 private:
  void bound_locked(Cost lower_bound);
  void tell(RunEvent event, const Progress& progress);

  RunObserver& observer_;
  const std::function<Progress()> progress_;
  std::function<RunStatistics()> survey_;  // may be empty
  std::mutex mutex_;
  Cost announced_bound_ = 0;  // under mutex_
};

}  // namespace grove::detail
