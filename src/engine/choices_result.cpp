// SPDX-License-Identifier: MIT
#include "engine/choices_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "engine/adaptations.h"
#include "engine/restriction.h"
#include "engine/single_assignment.h"

namespace grove::detail {
namespace {

bool fits(const Instance& instance, const Assignment& assignment) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (instance.agent(i).tasks.size() + assignment[i].visits.size() > kMaxTasksPerAgent)
      return false;
  return true;
}

}  // namespace

ChoicesResult::ChoicesResult(const Instance& instance, const SolveOptions& options,
                             const Limits& limits, MergedObserver& merged, Cost bound)
    : instance_(instance),
      options_(options),
      of_part_(options),
      limits_(limits),
      merged_(merged),
      bound_(bound) {
  of_part_.proof = nullptr;
  best_.omega = options.omega;
}

std::optional<Cost> ChoicesResult::incumbent() const {
  return best_.plan ? std::optional(best_.plan->cost) : std::nullopt;
}

bool ChoicesResult::is_final() const {
  return best_.status == Status::kInfeasible ||
         (best_.plan && options_.omega.accepts(best_.plan->cost, best_.lower_bound));
}

Cost ChoicesResult::search(const Assignment& assignment, double share) {
  if (!fits(instance_, assignment)) return 0;
  ++searched_;
  Cost proven = 0;
  const Limits part = part_of(limits_, options_, share);
  const Restriction restriction = restriction_to(instance_, assignment, reported(), cost());
  Solution solution =
      solve_restriction(restriction, of_part_.omega, part, merged_, [&](RunObserver& stage) {
        Solution own = solve(restriction.instance, of_part_, part, &stage);
        proven = own.status == Status::kInfeasible ? kInfiniteCost : own.lower_bound;
        return own;
      });
  best_ = merged_result(best_, std::move(solution));
  return proven;
}

Cost ChoicesResult::search(RouteBound& choices, std::int64_t effort) {
  const auto cores = AllAssignmentsSearch::make(instance_, choices, cost(), of_part_, limits_);
  if (!cores) return 0;
  cores->run(cost(), effort);
  add_counts_of(*cores);
  if (cores->plan() && cores->plan()->cost < cost()) use_plan(*cores->plan(), PlanSource::kCores);
  return cores->lower_bound();
}

void ChoicesResult::use_plan(Plan plan, PlanSource source) {
  best_.plan = std::move(plan);
  state(reported());
  merged_.incumbent(*best_.plan, source, progress());
  report(RunEvent::kIncumbent);
}

void ChoicesResult::raise_bound(Cost proven, ComponentId source, bool is_certified) {
  if (proven <= (is_certified ? reported() : bound_)) return;
  set_bound(proven, source, is_certified);
  report(RunEvent::kBound);
}

void ChoicesResult::use_plan_and_bound(Plan plan, PlanSource source, Cost proven,
                                       ComponentId bound_source) {
  best_.plan = std::move(plan);
  set_bound(proven, bound_source, true);
  merged_.incumbent(*best_.plan, source, progress());
  report(RunEvent::kIncumbent);
}

void ChoicesResult::set_bound(Cost proven, ComponentId source, bool is_certified) {
  if (is_certified) certified_ = std::max(certified_, std::min(proven, cost()));
  bound_ = std::min(std::max(bound_, proven), cost());
  state(reported());
  merged_.begin_search();
  merged_.outside_bound(source);
}

void ChoicesResult::state(Cost bound) {
  best_.lower_bound = bound;
  best_.status = status_of(incumbent(), bound, options_.omega);
}

void ChoicesResult::report(RunEvent event) {
  std::map<std::string, std::int64_t> counts;
  add(outside_counters(), counts);
  merged_.event_outside(event, progress(), std::move(counts));
}

// The counters of the run without the searches of single assignments.
Counters ChoicesResult::outside_counters() const {
  Counters counters = ended_;
  if (running_) running_->add_counts(counters);
  counters[Counter::kAssignments] = searched_;
  return counters;
}

void ChoicesResult::prove_infeasible() {
  const std::string reason = "no assignment of the tasks and goals has a plan";
  merged_.infeasible(reason);
  best_.status = Status::kInfeasible;
  best_.lower_bound = 0;
  best_.stats.texts["reason"] = reason;
}

Solution ChoicesResult::finish() {
  add(outside_counters(), best_.stats.counts);
  auto& texts = best_.stats.texts;
  texts.erase("stopped_by");
  texts.erase("remark");
  if (best_.status != Status::kInfeasible) state(std::max(reported(), best_.lower_bound));
  if (is_final()) return std::move(best_);
  if (limits_.stop_requested()) texts["stopped_by"] = stop_text(limits_.reason());
  texts["remark"] = fmt::format(
      "assignments searched: {}{}; the lower bound holds for all assignments", searched_,
      limits_.stop_requested() ? "" : ", no further one found that could be cheaper");
  return std::move(best_);
}

}  // namespace grove::detail
