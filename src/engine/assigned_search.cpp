// SPDX-License-Identifier: MIT
// *Assignments.* The first is that of the old plan; insertion completes it if visits are missing,
// for example those of new tasks, and leaves all other visits where they are. The second results
// from the first by large neighbourhood search, so its routes never cost more. It is searched
// first. Without a gain in the cost of the routes both are the same, and then only one search is
// needed: agents do not exchange tasks without a gain.
//
// *Further assignments.* If the result is not within omega and there is time left, the search of
// engine/choices.h follows, unless steps are committed or early visits have a weight. Its plan
// replaces the first one only if it costs less.
//
// *Never worse.* If the old plan is valid, it is the result unless a search finds a better one. The
// first assignment is in most cases that of the old plan, so its search starts from the old plan.
// (Visits beyond the need of a task are left out, and routes that end on one place are changed.)
//
// *Committed steps.* Visits that the old plan makes or begins within the committed steps are part
// of both assignments, so no other agent makes them a second time.
#include "engine/assigned_search.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "assignment/choice_bounds.h"
#include "assignment/infeasible_choices.h"
#include "engine/adaptations.h"
#include "engine/choices.h"
#include "engine/merged_observer.h"
#include "engine/restriction.h"
#include "engine/single_assignment.h"

namespace grove::detail {
namespace {

// Shares of the time that is left: for the bound, for the second assignment, and for its search if
// the search of the first one can follow.
constexpr double kShareForBound = 0.05;
constexpr double kShareForAssignment = 0.2;
constexpr double kShareForSearch = 0.5;
// The local search for the second assignment: insertions into a route in a round (5 ms), and rounds
// without a gain after which it ends.
constexpr std::int64_t kInsertions = 100'000;
constexpr int kRoundsWithoutGain = 4;

class AssignedRun {
 public:
  AssignedRun(const AssignedSearch& search, const SolveOptions& options, const Limits& limits,
              MergedObserver& merged)
      : search_(search), options_(options), limits_(limits), merged_(merged) {}

  Solution run() {
    Solution solution;
    try {
      solution = search_two();
    } catch (const InstanceError& error) {  // too many committed visits of an agent
      solution = kept_plan(without_assignment(options_, limits_, bound_, error.what()));
    }
    return needs_more(solution) ? with_further_assignments(solution) : solution;
  }

 private:
  Solution search_two() {
    bound_ = lower_bound_of_choices(search_.instance, search_.distances, part(kShareForBound));
    if (bound_ >= kInfiniteCost) return without_ways_to_goals();
    AssignmentSearch assignments(search_.instance, search_.distances, options_.seed,
                                 options_.visit_weight);
    const auto first = assignments.first_from(search_.old, limits_);
    if (!first) return kept_plan(without_assignment(options_, limits_, bound_));
    const Assignment second = improved(assignments);
    const Assignment begun = begun_visits();
    const Assignment last = with_visits(*first, begun);
    const Assignment better = with_visits(second, begun);
    Solution solution;
    if (better != last) {
      solution = search_one(better, part(kShareForSearch));
      if (is_better_than_old(solution)) return solution;
    }
    return kept_plan(search_one(last, limits_));
  }

  Solution without_ways_to_goals() {
    merged_.infeasible(kNoWayToGoals);
    bound_ = 0;
    return infeasible_solution(options_, kNoWayToGoals);
  }

  Assignment improved(AssignmentSearch& assignments) const {
    const Limits limits = part(kShareForAssignment);
    Assignment result;
    for (int failures = 0; failures < kRoundsWithoutGain; ++failures) {
      const Cost before = assignments.routes().cost();
      result = assignments.improved(kInsertions, limits);
      if (assignments.routes().cost() < before) failures = -1;
      if (limits.stop_requested()) break;
    }
    return result;
  }

  bool needs_more(const Solution& solution) const {
    if (limits_.stop_requested() || search_.commit > 0) return false;
    if (!solution.plan) return solution.status == Status::kUnknown;
    return options_.visit_weight == 0 &&
           !options_.omega.accepts(solution.plan->cost, solution.lower_bound);
  }

  Solution with_further_assignments(const Solution& first) {
    Stage stage(merged_);
    Solution solution =
        merged_result(first, solve_with_choices(search_.instance, options_, limits_, stage));
    if (first.plan && solution.plan && solution.plan->cost == first.plan->cost)
      solution.plan = first.plan;
    return solution;
  }

  Limits part(double share) const { return part_of(limits_, options_, share); }

  // The visits to tasks with a choice that the old plan makes or begins in the committed steps.
  Assignment begun_visits() const {
    Assignment begun = assignment_of(search_.instance, search_.old);
    for (AgentIndex i = 0; i < search_.instance.agent_count(); ++i) {
      const std::vector<WorkTime>& work = search_.old.agents[i].work;
      std::erase_if(begun[i].visits, [&](TaskIndex task) {
        const WorkTime& visit = *std::ranges::find(work, task, &WorkTime::task);
        return visit.begin >= search_.commit && visit.end > search_.commit;
      });
    }
    return begun;
  }

  // Adds `visits`, and in return removes other visits that are then not needed.
  Assignment with_visits(Assignment assignment, const Assignment& visits) const {
    for (std::size_t i = 0; i < visits.size(); ++i)
      for (const TaskIndex task : visits[i].visits) {
        std::vector<TaskIndex>& own = assignment[i].visits;
        if (std::ranges::binary_search(own, task)) continue;
        own.insert(std::ranges::upper_bound(own, task), task);
        remove_surplus(assignment, task, visits);
      }
    return assignment;
  }
  void remove_surplus(Assignment& assignment, TaskIndex task, const Assignment& kept) const {
    const auto visits = [&](const AgentChoice& choice) {
      return std::ranges::binary_search(choice.visits, task);
    };
    const auto count = std::ranges::count_if(assignment, visits);
    for (std::size_t i = 0; i < assignment.size(); ++i)
      if (count > search_.instance.task(task).need && visits(assignment[i]) && !visits(kept[i])) {
        std::erase(assignment[i].visits, task);
        return;
      }
  }

  Solution search_one(const Assignment& assignment, const Limits& limits) {
    const Restriction restriction = restriction_to(search_.instance, assignment, bound_);
    const Instance& fixed = restriction.instance;
    std::vector<bool> changed = search_.affected;
    for (AgentIndex i = 0; i < fixed.agent_count(); ++i)
      changed[i] = changed[i] || !serves(fixed, i, search_.old.agents[i]);
    const Plan start = without_other_visits(fixed, search_.old);
    Solution solution = solve_restriction(
        restriction, options_.omega, limits, merged_,
        [&](RunObserver& stage) { return search_.search(fixed, start, changed, limits, stage); });
    // It would hold only for the assignment.
    solution.stats.counts.erase("lower_bound_committed");
    return solution;
  }

  Cost value_of(const Plan& plan) const { return objective(plan, options_); }
  bool is_better_than_old(const Solution& solution) const {
    return solution.plan && (!search_.is_valid || value_of(*solution.plan) < value_of(search_.old));
  }
  // The solution, with the old plan if it is valid and better.
  Solution kept_plan(Solution solution) const {
    if (!search_.is_valid || is_better_than_old(solution)) return solution;
    if (solution.plan && value_of(*solution.plan) == value_of(search_.old)) return solution;
    if (solution.plan) solution.stats.texts.erase("remark");  // it is about that plan
    return with_plan(std::move(solution), search_.old);
  }

  const AssignedSearch& search_;
  const SolveOptions& options_;
  const Limits& limits_;
  MergedObserver& merged_;
  Cost bound_ = 0;  // for all assignments
};

}  // namespace

Cost objective(const Plan& plan, const SolveOptions& options) {
  Cost visits = 0;
  for (const AgentPlan& agent : plan.agents)
    for (const WorkTime& work : agent.work) visits += work.end;
  return plan.cost + options.visit_weight * visits;
}

Solution search_assigned(const AssignedSearch& search, const SolveOptions& options,
                         const Limits& limits, RunObserver& observer) {
  if (const auto reason = infeasible_choices(search.instance, search.distances))
    return infeasible_solution(options, *reason, observer);
  MergedObserver merged(observer);
  Solution solution = AssignedRun(search, options, limits, merged).run();
  merged.end();
  return solution;
}

}  // namespace grove::detail
