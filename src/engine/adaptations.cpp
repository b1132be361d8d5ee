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

#include <fmt/format.h>

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
#include "model/limits.h"

namespace grove::detail {
namespace {

constexpr double kShareOfFirst = 2.0 / 3;  // of the time; see paper, section V-B

// Forwards the events of several consecutive searches to one observer, as if they were one search.
class MergedObserver {
 public:
  explicit MergedObserver(RunObserver& next) : next_(next) {}

  void begin_search() { before_ = last_; }
  void incumbent(const Plan& plan, PlanSource source, const Progress& progress) {
    is_better_ = !last_.incumbent || plan.cost < *last_.incumbent;
    if (!is_better_) return;
    last_.incumbent = plan.cost;
    next_.on_incumbent(plan, source, of_whole(progress));
  }
  void event(RunEvent event, const Progress& progress) {
    searched_ = true;
    const Cost bound = last_.lower_bound;
    last_ = of_whole(progress);
    const bool is_news = event == RunEvent::kIncumbent ? is_better_
                         : event == RunEvent::kBound   ? last_.lower_bound > bound
                                                       : true;
    ends_ = event == RunEvent::kEnd;
    if (!ends_) next_.on_event(is_news ? event : RunEvent::kProgress, last_);
  }
  // Always requests the statistics at the end of a search, because they are added to those of later
  // searches.
  bool wants_statistics() { return ends_ || next_.wants_statistics(); }
  void statistics(RunStatistics statistics) {
    for (const auto& [name, count] : done_) statistics.whole.counts[name] += count;
    if (ends_) done_ = statistics.whole.counts;
    next_.on_statistics(statistics);
  }
  void root(const NodePtr& root) { next_.on_root(root); }
  void expanded(const NodePtr& node, const Expansion& expansion, int worker) {
    next_.on_expanded(node, expansion, worker);
  }
  void note(std::string_view note) { next_.on_note(note); }
  void outside_bound(ComponentId by) { next_.on_outside_bound(by); }
  void infeasible(std::string_view reason) { next_.on_infeasible(reason); }
  void end() {
    if (searched_) next_.on_event(RunEvent::kEnd, last_);
  }

 private:
  Progress of_whole(Progress progress) const {
    progress.nodes_expanded += before_.nodes_expanded;
    progress.trees += before_.trees;
    progress.lower_bound = std::max(last_.lower_bound, progress.lower_bound);
    progress.incumbent = last_.incumbent;
    return progress;
  }

  RunObserver& next_;
  Progress before_;  // at the start of the current search
  Progress last_;
  std::map<std::string, std::int64_t> done_;  // counts of the earlier searches
  bool is_better_ = false;
  bool searched_ = false;
  bool ends_ = false;  // a search is ending
};

// Observer of a search of the original instance (A).
class Stage : public RunObserver {
 public:
  explicit Stage(MergedObserver& merged) : merged_(merged) { merged.begin_search(); }

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    merged_.incumbent(of_whole(plan), source, of_whole(progress));
  }
  void on_event(RunEvent event, const Progress& progress) override {
    merged_.event(event, of_whole(progress));
  }
  void on_outside_bound(ComponentId by) override { merged_.outside_bound(by); }
  void on_infeasible(std::string_view reason) override { merged_.infeasible(reason); }
  bool wants_statistics() override { return merged_.wants_statistics(); }
  void on_statistics(const RunStatistics& statistics) override { merged_.statistics(statistics); }
  void on_root(const NodePtr& root) override { merged_.root(root); }
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override {
    merged_.expanded(node, expansion, worker);
  }

 private:
  virtual Plan of_whole(const Plan& plan) const { return plan; }
  // The bound on the original instance that a bound of this search proves.
  virtual Cost proven_by(Cost bound) const { return bound; }

  Progress of_whole(Progress progress) const {
    progress.lower_bound = proven_by(progress.lower_bound);
    return progress;
  }

  MergedObserver& merged_;
};

// Observer of a search of the instance with chosen destinations (B).
class StageOfB : public Stage {
 public:
  StageOfB(MergedObserver& merged, const Instance& instance, const Destinations& destinations)
      : Stage(merged), instance_(instance), destinations_(destinations) {}

  // Not forwarded, because these results hold only for the chosen destinations.
  void on_infeasible(std::string_view) override {}
  void on_outside_bound(ComponentId) override {}

 private:
  Plan of_whole(const Plan& plan) const override {
    return without_destinations(instance_, destinations_, plan);
  }
  Cost proven_by(Cost) const override { return destinations_.bound; }

  const Instance& instance_;
  const Destinations& destinations_;
};

bool was_stopped(const Solution& solution) {
  return solution.stats.texts.contains("stopped_by");
}

Solution stopped(const SolveOptions& options, const Limits& limits) {
  Solution solution;
  solution.omega = options.omega;
  solution.stats.texts["stopped_by"] = stop_text(limits.reason());
  return solution;
}

void note_chosen_destinations(Stats& stats) {
  stats.texts.erase("reason");
  stats.texts["remark"] =
      "no plan ends on the chosen tasks; plans that end on other tasks may exist";
}

Solution choose_and_solve(const Instance& instance, const SolveOptions& options,
                          const Limits& limits, RunObserver& observer, MergedObserver& merged) {
  const Problem problem(instance, limits, options.threads);
  if (auto answer = presolve(problem, options, limits, observer)) return std::move(*answer);
  const auto destinations = choose_destinations(problem, options.tuning.visitor_steps, limits);
  if (!destinations && limits.stop_requested()) return stopped(options, limits);
  if (!destinations)
    throw std::logic_error("internal error: agents that can rest have no place of rest");

  merged.note(
      "One task of each agent without a goal becomes its goal; the lower bound is for all plans.");
  StageOfB stage(merged, instance, *destinations);
  Solution solution = solve(with_destinations(instance, *destinations), options, limits, &stage);
  if (solution.plan)
    solution.plan = without_destinations(instance, *destinations, std::move(*solution.plan));
  else if (solution.status == Status::kInfeasible)
    note_chosen_destinations(solution.stats);
  const Cost own_bound = std::exchange(solution.lower_bound, destinations->bound);
  const auto cost = solution.plan ? std::optional(solution.plan->cost) : std::nullopt;
  solution.status = status_of(cost, solution.lower_bound, options.omega);
  if (solution.status == Status::kFeasible && !was_stopped(solution))
    solution.stats.texts["remark"] = fmt::format(
        "within omega of {}, the lower bound for plans that end on the chosen tasks, but not of "
        "the bound for all plans",
        own_bound);
  return solution;
}

Solution solve_b(const Instance& instance, const SolveOptions& options, const Limits& limits,
                 RunObserver& observer, MergedObserver& merged) {
  try {
    return choose_and_solve(instance, options, limits, observer, merged);
  } catch (const std::bad_alloc&) {  // before the search, which handles its own exceptions
    limits.memory_exhausted();
    return stopped(options, limits);
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
