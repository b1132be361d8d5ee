// SPDX-License-Identifier: MIT
// CTS-CBS-B and CTS-CBS-C, and the bounds that they prove.
//
// B searches the instance with chosen destinations. A plan of that instance is a plan of the
// original instance, because its agents rest on tasks of their own. The converse is false, so the
// lower bound of B's search, or its proof of infeasibility, holds only for these destinations. The
// only bound that B reports for the original instance is the one returned with the choice
// (destinations.h): the sum of the agents' best sequence costs, wherever they end. B's search ends
// when its plan is within w of the search's own bound. The reported status refers to the reported
// bound, so it can be `feasible`.
//
// C runs two searches, A and B, for one instance, and reports the better plan and the greater
// bound.
#include "engine/adaptations.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "engine/destinations.h"
#include "engine/merged_observer.h"
#include "engine/restriction.h"
#include "model/limits.h"

namespace grove::detail {
namespace {

constexpr double kShareOfFirst = 2.0 / 3;  // of the time; see paper, section V-B

Solution choose_and_solve(const Instance& instance, const SolveOptions& options,
                          const Limits& limits, RunObserver& observer, MergedObserver& merged) {
  const Problem problem(instance, limits, options.threads);
  if (auto answer = presolve(problem, options, limits, observer)) return std::move(*answer);
  const auto destinations = choose_destinations(problem, options.tuning.visitor_steps, limits);
  if (!destinations && limits.stop_requested()) return stopped_solution(options, limits);
  if (!destinations)
    throw std::logic_error("internal error: agents that can rest have no place of rest");

  merged.note(
      "One task of each agent without a goal becomes its goal; the lower bound is for all plans.");
  const Restriction restriction{
      .instance = with_destinations(instance, *destinations),
      .to_whole =
          [&](const Plan& plan) { return without_destinations(instance, *destinations, plan); },
      .bound = destinations->bound,
      .plans = "plans that end on the chosen tasks",
      .has_no_plan = "no plan ends on the chosen tasks; plans that end on other tasks may exist"};
  return solve_restriction(restriction, options, limits, merged);
}

Solution solve_b(const Instance& instance, const SolveOptions& options, const Limits& limits,
                 RunObserver& observer, MergedObserver& merged) {
  try {
    return choose_and_solve(instance, options, limits, observer, merged);
  } catch (const std::bad_alloc&) {  // before the search, which handles its own exceptions
    limits.memory_exhausted();
    return stopped_solution(options, limits);
  }
}

Solution solve_a(const Instance& instance, const SolveOptions& options, const Limits& limits,
                 MergedObserver& merged) {
  merged.note("The agents may end on any of their tasks.");
  Stage stage(merged);
  return solve(instance, options, limits, &stage);
}

bool is_within_omega(const Solution& solution) {
  return solution.status == Status::kOptimal || solution.status == Status::kBounded;
}

}  // namespace

Solution merged_result(const Solution& first, Solution second) {
  if (second.status == Status::kInfeasible) return second;
  auto& texts = second.stats.texts;
  if (!second.plan && !was_stopped(second) && was_stopped(first))
    texts["stopped_by"] = first.stats.texts.at("stopped_by");
  if (first.plan && (!second.plan || first.plan->cost < second.plan->cost))
    second.plan = first.plan;
  second.lower_bound = std::max(first.lower_bound, second.lower_bound);
  const auto cost = second.plan ? std::optional(second.plan->cost) : std::nullopt;
  second.status = status_of(cost, second.lower_bound, second.omega);
  if (is_within_omega(second))
    for (const char* key : {"remark", "stopped_by"}) texts.erase(key);
  for (const auto& [name, count] : first.stats.counts) second.stats.counts[name] += count;
  return second;
}

Solution solve_with_destinations(const Instance& instance, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer) {
  MergedObserver merged(observer);
  Solution solution = solve_b(instance, options, limits, observer, merged);
  merged.end();
  return solution;
}

Solution solve_with_destinations_last(const Instance& instance, const SolveOptions& options,
                                      const Limits& limits, RunObserver& observer) {
  MergedObserver merged(observer);
  const Limits part(limits, kShareOfFirst * limits.seconds_left());
  Solution solution = solve_a(instance, options, part, merged);
  if (was_stopped(solution) && !limits.stop_requested())
    solution = merged_result(solution, solve_b(instance, options, limits, observer, merged));
  merged.end();
  return solution;
}

Solution solve_with_destinations_first(const Instance& instance, const SolveOptions& options,
                                       const Limits& limits, RunObserver& observer) {
  MergedObserver merged(observer);
  const Limits part(limits, kShareOfFirst * limits.seconds_left());
  Solution solution = solve_b(instance, options, part, observer, merged);
  const bool is_final = is_within_omega(solution) || solution.status == Status::kInfeasible;
  if (!is_final && !limits.stop_requested()) {
    SolveOptions from_there = options;
    from_there.start = solution.plan;
    solution = merged_result(solution, solve_a(instance, from_there, limits, merged));
  }
  merged.end();
  return solution;
}

}  // namespace grove::detail
