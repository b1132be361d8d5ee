// SPDX-License-Identifier: MIT
// What B proves. A plan of the instance with destinations is one of the instance without: its
// agents rest on tasks of their own. But not the other way round, so what B's search proves, its
// lower bound or that there is no plan, holds for those destinations only. All that B says of the
// instance is the bound that came with the choice (destinations.h): so much the agents' best
// sequences cost wherever they end. B is done when its own search is, within w of its own bound;
// the status compares with the bound that is proven, and may well be `feasible`.
//
// C is two searches of one instance: the better plan and the greater bound stand.
#include "adaptations.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "grove/engine/destinations.h"
#include "stop_text.h"

namespace grove {
namespace {

constexpr double kShareOfFirst = 2.0 / 3;  // of the time, paper, section V-B

// What earlier searches of the same instance did and found.
struct Before {
  std::int64_t nodes_expanded = 0;
  std::int64_t trees = 0;
  Cost lower_bound = 0;
  std::optional<Cost> cost;
};

// Tells an observer of one search among several, as if they were one.
class Stage : public RunObserver {
 public:
  Stage(RunObserver& next, Before before, bool is_last)
      : next_(next), before_(before), is_last_(is_last) {}

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    is_better_ = !before_.cost || plan.cost < *before_.cost;
    if (!is_better_) return;
    before_.cost = plan.cost;
    next_.on_incumbent(of_whole(plan), source, of_whole(progress));
  }
  void on_event(RunEvent event, const Progress& progress) override {
    if (event == RunEvent::kEnd && !is_last_) return;
    if (event == RunEvent::kIncumbent && !is_better_) event = RunEvent::kProgress;
    next_.on_event(event, of_whole(progress));
  }

 protected:
  virtual Plan of_whole(const Plan& plan) const { return plan; }
  // What a bound of this search proves of the instance.
  virtual Cost proven_by(Cost bound) const { return bound; }

 private:
  Progress of_whole(Progress progress) const {
    progress.nodes_expanded += before_.nodes_expanded;
    progress.trees += before_.trees;
    progress.lower_bound = std::max(before_.lower_bound, proven_by(progress.lower_bound));
    if (before_.cost)
      progress.incumbent = std::min(*before_.cost, progress.incumbent.value_or(kInfiniteCost));
    return progress;
  }

  RunObserver& next_;
  Before before_;
  const bool is_last_;
  bool is_better_ = false;
};

// The search of an instance with destinations.
class StageOfB : public Stage {
 public:
  StageOfB(RunObserver& next, Before before, bool is_last, const Instance& instance,
           const Destinations& destinations)
      : Stage(next, before, is_last), instance_(instance), destinations_(destinations) {}

 private:
  Plan of_whole(const Plan& plan) const override {
    return without_destinations(instance_, destinations_, plan);
  }
  Cost proven_by(Cost) const override { return destinations_.bound; }

  const Instance& instance_;
  const Destinations& destinations_;
};

Solution stopped(const SolveOptions& options, const Limits& limits) {
  Solution solution;
  solution.omega = options.omega;
  solution.stats.texts["stopped_by"] = stop_text(limits.reason());
  return solution;
}

Solution solve_b(const Instance& instance, const SolveOptions& options, const Limits& limits,
                 RunObserver& observer, const Before& before, bool is_last) {
  const Problem problem(instance, limits);
  if (auto answer = answer_without_search(problem, options, limits, observer))
    return std::move(*answer);
  const auto destinations = choose_destinations(problem, limits);
  if (!destinations && limits.stop_requested()) return stopped(options, limits);
  if (!destinations)
    throw std::logic_error("internal error: agents that can rest have nowhere to do so");

  StageOfB stage(observer, before, is_last, instance, *destinations);
  Solution solution = solve(with_destinations(instance, *destinations), options, limits, &stage);
  if (solution.plan)
    solution.plan = without_destinations(instance, *destinations, std::move(*solution.plan));
  else if (solution.status == Status::kInfeasible)
    solution.stats.texts["reason"] = "no plan ends on the tasks that were chosen";
  solution.lower_bound = destinations->bound;
  const auto cost = solution.plan ? std::optional(solution.plan->cost) : std::nullopt;
  solution.status = status_of(cost, solution.lower_bound, options.omega);
  return solution;
}

Solution solve_a(const Instance& instance, const SolveOptions& options, const Limits& limits,
                 RunObserver& observer, const Before& before, bool is_last) {
  Stage stage(observer, before, is_last);
  return solve(instance, options, limits, &stage);
}

Before summary(const Solution& solution) {
  const auto count = [&](const char* name) {
    const auto found = solution.stats.counts.find(name);
    return found == solution.stats.counts.end() ? 0 : found->second;
  };
  Before before;
  before.nodes_expanded = count("nodes_expanded");
  before.trees = count("roots_generated");
  before.lower_bound = solution.lower_bound;
  if (solution.plan) before.cost = solution.plan->cost;
  return before;
}

// Nothing is left for another search.
bool is_over(const Solution& solution, const Limits& limits) {
  return solution.status == Status::kOptimal || solution.status == Status::kBounded ||
         solution.status == Status::kInfeasible || limits.stop_requested();
}

// How the run ended is how the second search did.
Solution both(const Solution& first, Solution second) {
  if (second.status == Status::kInfeasible) return second;
  if (first.plan && (!second.plan || first.plan->cost < second.plan->cost))
    second.plan = first.plan;
  second.lower_bound = std::max(first.lower_bound, second.lower_bound);
  const auto cost = second.plan ? std::optional(second.plan->cost) : std::nullopt;
  second.status = status_of(cost, second.lower_bound, second.omega);
  for (const auto& [name, count] : first.stats.counts) second.stats.counts[name] += count;
  return second;
}

}  // namespace

Solution solve_with_destinations(const Instance& instance, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer) {
  return solve_b(instance, options, limits, observer, {}, true);
}

Solution solve_with_destinations_last(const Instance& instance, const SolveOptions& options,
                                      const Limits& limits, RunObserver& observer) {
  const Limits part(limits, kShareOfFirst * limits.seconds_left());
  const Solution first = solve_a(instance, options, part, observer, {}, false);
  if (first.stats.texts.count("stopped_by") == 0 || is_over(first, limits)) return first;
  return both(first, solve_b(instance, options, limits, observer, summary(first), true));
}

Solution solve_with_destinations_first(const Instance& instance, const SolveOptions& options,
                                       const Limits& limits, RunObserver& observer) {
  const Limits part(limits, kShareOfFirst * limits.seconds_left());
  const Solution first = solve_b(instance, options, part, observer, {}, false);
  if (is_over(first, limits)) return first;
  SolveOptions from_there = options;
  from_there.start = first.plan;
  return both(first, solve_a(instance, from_there, limits, observer, summary(first), true));
}

}  // namespace grove
