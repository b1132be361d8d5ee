// SPDX-License-Identifier: MIT
#include "engine/single_assignment.h"

#include <chrono>

namespace grove::detail {

Limits part_of(const Limits& limits, const SolveOptions& options, double share) {
  const double seconds = limits.seconds_left();
  return {limits, options.deterministic ? seconds : share * seconds};
}

double turn_seconds(const SolveOptions& options, const Limits& limits,
                    Limits::Clock::time_point start) {
  if (options.deterministic) return 1;
  return std::chrono::duration<double>(limits.now() - start).count();
}

Restriction restriction_to(const Instance& instance, const Assignment& assignment, Cost bound,
                           Cost cutoff) {
  return {.instance = with_assignment(instance, assignment),
          .to_whole = [&](const Plan& plan) { return with_stated_visits(instance, plan); },
          .bound = bound,
          .cutoff = cutoff,
          .plans = "plans with the chosen assignment",
          .has_no_plan = "the chosen assignment has no plan; other assignments may have one"};
}

Solution infeasible_solution(const SolveOptions& options, const std::string& reason,
                             RunObserver& observer) {
  observer.on_infeasible(reason);
  return infeasible_solution(options, reason);
}

Solution infeasible_solution(const SolveOptions& options, const std::string& reason) {
  Solution solution;
  solution.status = Status::kInfeasible;
  solution.omega = options.omega;
  solution.stats.texts["reason"] = reason;
  return solution;
}

Solution without_assignment(const SolveOptions& options, const Limits& limits, Cost bound,
                            const std::string& remark) {
  Solution solution;
  if (limits.stop_requested()) {
    solution = stopped_solution(options, limits);
  } else {
    solution.omega = options.omega;
    solution.stats.texts["remark"] = remark;
  }
  solution.lower_bound = bound;
  return solution;
}

Solution with_plan(Solution solution, const Plan& plan) {
  solution.plan = plan;
  solution.status = status_of(plan.cost, solution.lower_bound, solution.omega);
  return solution;
}

}  // namespace grove::detail
