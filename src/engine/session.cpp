// SPDX-License-Identifier: MIT
// Problem: robots may be late while a plan with committed steps is computed. The new plan must be
// safe for any delays.
// Claim: the new plan permits every state that robots can reach under the old plan within the
// committed steps.
// Proof: the committed steps are a prefix of the old plan. An action waits only for actions that
// start no later in the plan, so the set of actions of the prefix is closed under the dependencies
// of the passing order. The new plan starts with the same steps, so its passing order agrees with
// the old one on these actions. Hence, if robots execute some of these actions while the new plan
// is computed, in any order that the old passing order permits, the new passing order permits that,
// too.
#include "engine/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assignment/assignment.h"
#include "engine/assigned_search.h"
#include "engine/restriction.h"
#include "engine/run_observer.h"
#include "engine/single_assignment.h"
#include "execution/advance.h"
#include "model/assert.h"
#include "model/check.h"
#include "model/distance_field.h"
#include "planning/problem.h"
#include "primal/repair.h"
#include "search/feasibility.h"

namespace grove::detail {
namespace {

// Observer of the search after the committed steps. Converts its plans and solutions into plans and
// solutions of the whole instance.
class WholePlans : public ForwardingObserver {
 public:
  WholePlans(RunObserver& next, const Instance& instance, const Plan& plan, Time commit,
             const Instance& later, Cost lower_bound)
      : ForwardingObserver(next),
        instance_(instance),
        plan_(plan),
        commit_(commit),
        later_(later),
        lower_bound_(lower_bound) {}

  Solution whole(Solution solution) const {
    const bool is_stuck = solution.status == Status::kInfeasible;
    if (ends_are_free() && !is_stuck)
      solution.stats.counts["lower_bound_committed"] = cost_before() + solution.lower_bound;
    solution.lower_bound = lower_bound_;
    if (solution.plan) {
      solution.plan = whole(*solution.plan);
      solution.status = status_of(solution.plan->cost, lower_bound_, solution.omega);
    } else if (is_stuck) {  // plans with other first steps may exist
      solution.status = Status::kUnknown;
      solution.stats.texts["reason"] =
          "the committed steps leave no plan where agents without a destination end as in the old "
          "plan; fewer committed steps may leave one";
    }
    return solution;
  }

  void on_incumbent(const Plan& rest, PlanSource source, const Progress& progress) override {
    const Plan plan = whole(rest);
    cost_ = plan.cost;
    next().on_incumbent(plan, source, of_whole(progress));
  }
  void on_event(RunEvent event, const Progress& progress) override {
    next().on_event(event, of_whole(progress));
  }

 private:
  Plan whole(const Plan& rest) const {
    Plan plan = joined(instance_, plan_, commit_, later_, rest);
    require_valid_plan(instance_, plan);
    return plan;
  }

  Progress of_whole(Progress progress) const {
    progress.lower_bound = lower_bound_;
    progress.incumbent = cost_;
    return progress;
  }

  // True if each agent may rest wherever it may in the original instance.
  bool ends_are_free() const {
    for (AgentIndex agent = 0; agent < later_.agent_count(); ++agent)
      if (!instance_.agent(agent).goal &&
          later_.agent(agent).tasks.size() < instance_.agent(agent).tasks.size())
        return false;
    return true;
  }

  // Lower bound on the cost of the committed steps under any continuation. For an agent that has
  // nothing left to do, counts the steps until it came to rest; if it moves again, its cost only
  // increases.
  Cost cost_before() const {
    Cost cost = 0;
    for (AgentIndex agent = 0; agent < later_.agent_count(); ++agent) {
      const Agent& a = later_.agent(agent);
      const bool is_done = a.tasks.empty() && later_.may_rest(agent, a.start);
      cost += is_done ? finish_of_steps(plan_.agents[agent], commit_) : commit_;
    }
    return cost;
  }

  const Instance& instance_;
  const Plan& plan_;
  const Time commit_;
  const Instance& later_;
  const Cost lower_bound_;
  std::optional<Cost> cost_;
};

// Data kept between solves, so that the next solve reuses the distances.
struct SolvedInstance {
  SolvedInstance(Instance the_instance, const Limits& limits, int threads,
                 const DistanceFields* known)
      : instance(std::move(the_instance)), problem(instance, limits, threads, known) {}

  const Instance instance;
  const Problem problem;
};

// True if a search is needed: no limit was reached during the computation of the distances, and
// presolve does not prove infeasibility.
bool is_searched(const Problem& problem) {
  return problem.distances.complete() && !presolve_infeasibility(problem);
}

Solution unknown(const SolveOptions& options, const std::string& reason) {
  Solution solution;
  solution.omega = options.omega;
  solution.stats.texts["reason"] = reason;
  return solution;
}

// Returns a plan to start from: keeps the paths of the unaffected agents and re-plans the others.
// Returns nullopt if the repair fails or no search is needed.
std::optional<Plan> start_from(const Plan& plan, const std::vector<bool>& affected,
                               const Problem& problem, const SolveOptions& options,
                               const Limits& limits) {
  if (std::ranges::count(affected, true) == 0) return plan;
  if (!is_searched(problem)) return std::nullopt;
  std::vector<Path> paths(affected.size());
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    if (!affected[agent]) paths[agent] = walked_path(problem.instance, agent, plan.agents[agent]);
  AgentStopsCache stops(problem.instance, problem.distances);
  return repaired(problem, stops, paths, options.seed, limits);
}

// Observer of the first of possibly two searches. Forwards its end only when end() is called.
class FirstSearch : public ForwardingObserver {
 public:
  using ForwardingObserver::ForwardingObserver;
  void on_event(RunEvent event, const Progress& progress) override {
    if (event == RunEvent::kEnd)
      end_ = progress;
    else
      next().on_event(event, progress);
  }
  void on_infeasible(std::string_view reason) override { reason_ = reason; }

  void end() {
    if (reason_) next().on_infeasible(*reason_);
    if (end_) next().on_event(RunEvent::kEnd, *end_);
  }

 private:
  std::optional<Progress> end_;
  std::optional<std::string> reason_;
};

bool any(const std::vector<bool>& agents) {
  return std::ranges::count(agents, true) > 0;
}

std::vector<bool> either(std::vector<bool> agents, const std::vector<bool>& others) {
  for (std::size_t i = 0; i < agents.size(); ++i) agents[i] = agents[i] || others[i];
  return agents;
}

Solution solve_from(const Plan* plan, const std::vector<bool>& affected, const Problem& problem,
                    SolveOptions options, const Limits& limits, RunObserver& observer) {
  options.start = plan ? start_from(*plan, affected, problem, options, limits) : std::nullopt;
  return grove::detail::solve(problem, options, limits, &observer);
}

}  // namespace

class Session::Impl {
 public:
  Impl(Instance instance, std::optional<Plan> plan)
      : instance_(std::move(instance)),
        plan_(std::move(plan)),
        old_(plan_),
        affected_(static_cast<std::size_t>(instance_.agent_count())),
        ends_with_plan_(affected_) {}

  const Instance& instance() const { return instance_; }
  const std::optional<Plan>& plan() const { return plan_; }

  void advance(Time steps, std::span<const Delay> late) {
    GROVE_ASSERT(plan_, "advance() needs a plan");
    const bool is_anyone_late =
        std::ranges::any_of(late, [](const Delay& l) { return l.steps != 0; });
    const Plan executed = is_anyone_late ? executed_plan(steps, late) : *plan_;
    Remainder rest =
        grove::detail::advance(instance_, executed, steps, Rests::kAnywhere, ends_with_plan_);
    require_valid_plan(rest.instance, rest.plan);
    instance_ = std::move(rest.instance);
    plan_ = old_ = std::move(rest.plan);
    ends_with_plan_ = std::move(rest.ends_with_plan);
  }

  void change(const InstanceChange& change) {
    const Instance before = without_ends_of_plan(instance_, ends_with_plan_);
    Changed changed = apply(before, old_ ? *old_ : standing_plan(before), change);
    for (std::size_t agent = 0; agent < affected_.size(); ++agent) {
      affected_[agent] = affected_[agent] || changed.affected[agent] || !old_;
      // A re-planned agent may end wherever the instance permits.
      ends_with_plan_[agent] = ends_with_plan_[agent] && !affected_[agent];
    }
    instance_ = with_ends_of_plan(changed.instance, changed.plan, ends_with_plan_);
    old_ = std::move(changed.plan);
    cut_ = cut_.empty() ? std::move(changed.cut) : either(std::move(cut_), changed.cut);
    if (any(affected_) || !has_all_visits(*old_))
      plan_.reset();
    else
      plan_ = old_;
  }

  Solution solve(const SolveOptions& options, const Limits& limits, RunObserver& observer,
                 Time commit) {
    if (any(ends_with_plan_)) return solve_with_ends_of_plan(options, limits, observer, commit);
    return adopt(search(instance_, affected_, options, limits, observer, commit));
  }

 private:
  // The plan that robots execute if those in `late` are late at the end of `steps` steps.
  Plan executed_plan(Time steps, std::span<const Delay> late) const {
    const auto delayed = [&](const Instance& instance, const Plan& plan) {
      return delayed_plan(instance, plan, ActionDependencyGraph(instance, plan), steps, late);
    };
    if (!instance_.has_choices()) return delayed(instance_, *plan_);
    const FixedChoices fixed = fix_choices(instance_, *plan_);
    return with_stated_visits(instance_, delayed(fixed.instance, fixed.plan));
  }

  // True if the plan makes all visits to tasks with a choice of agents.
  bool has_all_visits(const Plan& plan) const {
    return !instance_.has_choices() || is_complete(instance_, assignment_of(instance_, plan));
  }

  // Solves first without the destinations that agents have only because of the old plan. Solves
  // with these destinations if the first search finds no plan, or one that costs more than the old
  // plan.
  Solution solve_with_ends_of_plan(const SolveOptions& options, const Limits& limits,
                                   RunObserver& observer, Time commit) {
    const Instance free = without_ends_of_plan(instance_, ends_with_plan_);
    const std::vector<bool> affected = either(affected_, ends_with_plan_);
    FirstSearch first(observer);
    Solution solution =
        search(free, affected, options, limits_of_first(options, limits), first, commit);
    const auto value = [&](const Plan& plan) {
      return instance_.has_choices() ? objective(plan, options) : plan.cost;
    };
    if (!solution.plan || (plan_ && value(*plan_) < value(*solution.plan))) {
      observer.on_note("no plan as good as the old one ends on remaining tasks");
      Solution other = search(instance_, affected_, options, limits, observer, commit);
      if (other.plan) {
        other.stats.texts["ends_of_old_plan"] = names(ends_with_plan_);
        return adopt(std::move(other));
      }
    } else {
      first.end();
    }
    instance_ = free;
    affected_ = affected;
    ends_with_plan_.assign(ends_with_plan_.size(), false);
    return adopt(std::move(solution));
  }

  // With choices, the first search often uses all of its time; half is left for the second one.
  Limits limits_of_first(const SolveOptions& options, const Limits& limits) const {
    return part_of(limits, options, instance_.has_choices() ? 0.5 : 1);
  }

  Solution search(const Instance& instance, const std::vector<bool>& affected,
                  const SolveOptions& options, const Limits& limits, RunObserver& observer,
                  Time commit) {
    if (instance.has_choices())
      return search_with_choices(instance, affected, options, limits, observer, commit);
    distances_.reset();
    return search_from(instance, old_ ? &*old_ : nullptr, affected, options, limits, observer,
                       commit);
  }

  // `old`: the plan to start from, or nullptr. Precondition: the instance has no choices.
  Solution search_from(const Instance& instance, const Plan* old, const std::vector<bool>& affected,
                       const SolveOptions& options, const Limits& limits, RunObserver& observer,
                       Time commit) {
    auto now = std::make_unique<SolvedInstance>(instance, limits, options.threads, known());
    Solution solution = commit > 0 && old && is_searched(now->problem)
                            ? solve_later(*now, *old, affected, options, limits, observer, commit)
                            : solve_from(old, affected, now->problem, options, limits, observer);
    require_valid_plan(now->instance, solution);
    solved_ = std::move(now);
    return solution;
  }

  Solution search_with_choices(const Instance& instance, const std::vector<bool>& affected,
                               const SolveOptions& options, const Limits& limits,
                               RunObserver& observer, Time commit) {
    distances_ = std::make_unique<DistanceFields>(instance, limits, options.threads, known());
    const bool is_valid = plan_ && !any(affected);
    if (!distances_->complete()) {
      Solution stopped = stopped_solution(options, limits);
      return is_valid ? with_plan(std::move(stopped), *plan_) : stopped;
    }
    const Plan old = old_ ? *old_ : standing_plan(instance);
    const AssignedSearch assigned{
        .instance = instance,
        .distances = *distances_,
        .old = old,
        .affected = affected,
        .is_valid = is_valid,
        .commit = old_ ? commit : 0,
        .search = [&](const Instance& fixed, const Plan& start, const std::vector<bool>& changed,
                      const Limits& part, RunObserver& stage) {
          return search_from(fixed, &start, changed, options, part, stage, old_ ? commit : 0);
        }};
    Solution solution = search_assigned(assigned, options, limits, observer);
    require_valid_plan(instance, solution);
    return solution;
  }

  // Distances of the last solve that the next one can use.
  const DistanceFields* known() const {
    if (distances_ && distances_->complete()) return distances_.get();
    return solved_ ? &solved_->problem.distances : nullptr;
  }

  std::string names(const std::vector<bool>& agents) const {
    std::vector<std::string> ids;
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      if (agents[agent]) ids.push_back(instance_.agent(agent).id);
    return fmt::format("{}", fmt::join(ids, ", "));
  }

  Solution adopt(Solution solution) {
    if (solution.plan) {
      plan_ = old_ = solution.plan;
      affected_.assign(affected_.size(), false);
      cut_.clear();
    }
    return solution;
  }

  void require_open(Time commit) const {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      const Time end = static_cast<Time>(old_->agents[agent].path.size()) - 1;
      if (!cut_.empty() && cut_[agent] && end < commit) throw NotCommitted(agent, end);
    }
  }

  Solution solve_later(const SolvedInstance& now, const Plan& old,
                       const std::vector<bool>& affected, const SolveOptions& options,
                       const Limits& limits, RunObserver& observer, Time commit) {
    require_open(commit);
    std::optional<Remainder> rest;
    try {
      rest = grove::detail::advance(now.instance, old, commit, Rests::kWhereItMust);
    } catch (const InstanceError& error) {
      return unknown(options, error.what());
    }
    const SolvedInstance later(std::move(rest->instance), limits, options.threads,
                               &now.problem.distances);
    AgentStopsCache stops(now.instance, now.problem.distances);
    const Cost individual_costs = sum_of_individual_costs(now.problem, stops, limits);
    WholePlans plans(observer, now.instance, old, commit, later.instance, individual_costs);
    Solution solution = solve_from(&rest->plan, affected, later.problem, options, limits, plans);
    return plans.whole(std::move(solution));
  }

  Instance instance_;
  std::optional<Plan> plan_;    // a valid plan of instance_
  std::optional<Plan> old_;     // last plan: valid except for the affected agents
  std::vector<bool> affected_;  // by agent
  std::vector<bool> cut_;       // by agent: its path enters a closed place; empty: no path does
  std::vector<bool> ends_with_plan_;  // by agent; see execution/advance.h
  std::unique_ptr<SolvedInstance> solved_;
  std::unique_ptr<DistanceFields> distances_;  // of the last solve of an instance with choices
};

Session::Session(Instance instance)
    : impl_(std::make_unique<Impl>(std::move(instance), std::nullopt)) {}
Session::Session(Instance instance, Plan plan)
    : impl_(std::make_unique<Impl>(std::move(instance), std::move(plan))) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

const Instance& Session::instance() const {
  return impl_->instance();
}
const std::optional<Plan>& Session::plan() const {
  return impl_->plan();
}
void Session::advance(Time steps, std::span<const Delay> late) {
  impl_->advance(steps, late);
}
void Session::change(const InstanceChange& change) {
  impl_->change(change);
}
Solution Session::solve(const SolveOptions& options, const Limits& limits, RunObserver* observer,
                        Time commit) {
  RunObserver silent;
  return impl_->solve(options, limits, observer ? *observer : silent, commit);
}

}  // namespace grove::detail
