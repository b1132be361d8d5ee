// SPDX-License-Identifier: MIT
#include "engine/restriction.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace grove::detail {
namespace {

class RestrictionStage : public Stage {
 public:
  RestrictionStage(MergedObserver& merged, const Restriction& restriction, const Limits& limits)
      : Stage(merged), restriction_(restriction), limits_(limits) {}

  void on_event(RunEvent event, const Progress& progress) override {
    Stage::on_event(event, progress);
    if (progress.lower_bound >= restriction_.cutoff) limits_.stop(StopReason::kTime);
  }

  // Not forwarded, because these results hold only for the restriction.
  void on_infeasible(std::string_view) override {}
  void on_outside_bound(ComponentId) override {}

 private:
  Plan of_whole(const Plan& plan) const override { return restriction_.to_whole(plan); }
  Cost proven_by(Cost) const override { return restriction_.bound; }

  const Restriction& restriction_;
  const Limits& limits_;
};

}  // namespace

Solution solve_restriction(const Restriction& restriction, const SolveOptions& options,
                           const Limits& limits, MergedObserver& merged) {
  return solve_restriction(restriction, options.omega, limits, merged, [&](RunObserver& stage) {
    return solve(restriction.instance, options, limits, &stage);
  });
}

Solution solve_restriction(const Restriction& restriction, Omega omega, const Limits& limits,
                           MergedObserver& merged,
                           const std::function<Solution(RunObserver&)>& search) {
  RestrictionStage stage(merged, restriction, limits);
  Solution solution = search(stage);
  if (solution.plan) {
    solution.plan = restriction.to_whole(*solution.plan);
  } else if (solution.status == Status::kInfeasible) {
    solution.stats.texts.erase("reason");
    solution.stats.texts["remark"] = restriction.has_no_plan;
  }
  const Cost own_bound = std::exchange(solution.lower_bound, restriction.bound);
  const auto cost = solution.plan ? std::optional(solution.plan->cost) : std::nullopt;
  solution.status = status_of(cost, solution.lower_bound, omega);
  if (solution.status == Status::kFeasible && omega.accepts(*cost, own_bound))
    solution.stats.texts["remark"] = fmt::format(
        "the cost is within omega of {}, the lower bound for {}, but not of the lower bound for "
        "all plans",
        own_bound, restriction.plans);
  return solution;
}

bool was_stopped(const Solution& solution) {
  return solution.stats.texts.contains("stopped_by");
}

Solution stopped_solution(const SolveOptions& options, const Limits& limits) {
  Solution solution;
  solution.omega = options.omega;
  solution.stats.texts["stopped_by"] = stop_text(limits.reason());
  return solution;
}

}  // namespace grove::detail
