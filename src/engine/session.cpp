// SPDX-License-Identifier: MIT
// Why a plan with committed steps is safe however late the robots are. What is committed is a
// beginning of the old plan: by its passing order, a set of actions that wait for nothing outside
// of it, for what an action waits for begins no later in the plan. The new plan begins with the
// same steps; so on these actions its passing order is the same. Robots that carry out some of them
// while the new plan is being found, in whatever order of time the old one allows, have done what
// the new one allows, too.
#include "grove/detail/engine/session.h"

#include <algorithm>
#include <utility>

#include "grove/detail/engine/run_observer.h"
#include "grove/detail/execution/advance.h"
#include "grove/detail/model/assert.h"
#include "grove/detail/primal/repair.h"
#include "grove/detail/search/feasibility.h"
#include "grove/detail/search/problem.h"

namespace grove::detail {
namespace {

// Shows the plans of what comes after the committed steps as whole ones.
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
    if (ends_are_free())
      solution.stats.counts["lower_bound_committed"] = cost_before() + solution.lower_bound;
    solution.lower_bound = lower_bound_;
    if (solution.plan) {
      solution.plan = whole(*solution.plan);
      solution.status = status_of(solution.plan->cost, lower_bound_, solution.omega);
    } else if (solution.status == Status::kInfeasible) {  // it is for those that begin like this
      solution.status = Status::kUnknown;
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
  Plan whole(const Plan& rest) const { return joined(instance_, plan_, commit_, later_, rest); }

  Progress of_whole(Progress progress) const {
    progress.lower_bound = lower_bound_;
    progress.incumbent = cost_;
    return progress;
  }

  // May all come to rest then wherever they may by the instance before?
  bool ends_are_free() const {
    for (AgentIndex agent = 0; agent < later_.agent_count(); ++agent)
      if (!instance_.agent(agent).goal &&
          later_.agent(agent).tasks.size() < instance_.agent(agent).tasks.size())
        return false;
    return true;
  }

  // What the committed steps cost whatever comes after: of who has nothing to do then, until it
  // came to rest. (If it moves all the same it costs more than its later moves, counted from
  // there.)
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

// What outlives a solve: its distances serve the next one.
struct Kept {
  Kept(Instance the_instance, const Limits& limits, int threads, const Kept* before)
      : instance(std::move(the_instance)),
        problem(instance, limits, threads, before ? &before->problem.distances : nullptr) {}

  const Instance instance;
  const Problem problem;
};

// Is there an answer to be searched for?
bool is_searched(const Problem& problem) {
  return problem.distances.complete() && !evident_infeasibility(problem);
}

Solution unknown(const SolveOptions& options, const std::string& reason) {
  Solution solution;
  solution.omega = options.omega;
  solution.stats.texts["reason"] = reason;
  return solution;
}

// The paths of a plan, none of those that have to be planned anew; then a plan, if they can be.
std::optional<Plan> start_from(const Plan& plan, const std::vector<bool>& affected,
                               const Problem& problem, const SolveOptions& options,
                               const Limits& limits) {
  if (std::ranges::count(affected, true) == 0) return plan;
  if (!is_searched(problem)) return std::nullopt;
  std::vector<Path> paths(affected.size());
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    if (!affected[agent]) paths[agent] = walked_path(problem.instance, agent, plan.agents[agent]);
  AgentStopsStore stops(problem.instance, problem.distances);
  return repaired(problem, stops, paths, options.seed, limits);
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
        affected_(static_cast<std::size_t>(instance_.agent_count())) {}

  const Instance& instance() const { return instance_; }
  const std::optional<Plan>& plan() const { return plan_; }

  void advance(Time steps, std::span<const Late> late) {
    GROVE_ASSERT(plan_, "time goes on by a plan");
    const Plan driven =
        late.empty() ? *plan_
                     : late_plan(instance_, *plan_, PassingOrder(instance_, *plan_), steps, late);
    Remainder rest = grove::detail::advance(instance_, driven, steps);
    instance_ = std::move(rest.instance);
    plan_ = old_ = std::move(rest.plan);
  }

  void change(const InstanceChange& change) {
    Changed changed = apply(instance_, old_ ? *old_ : standing_plan(instance_), change);
    for (std::size_t agent = 0; agent < affected_.size(); ++agent)
      affected_[agent] = affected_[agent] || changed.affected[agent] || !old_;
    instance_ = std::move(changed.instance);
    old_ = std::move(changed.plan);
    cut_ = std::move(changed.cut);
    if (std::ranges::count(affected_, true) > 0)
      plan_.reset();
    else
      plan_ = old_;
  }

  Solution solve(const SolveOptions& options, const Limits& limits, RunObserver& observer,
                 Time commit) {
    auto now = std::make_unique<Kept>(instance_, limits, options.threads, kept_.get());
    Solution solution = commit > 0 && old_ && is_searched(now->problem)
                            ? solve_later(*now, options, limits, observer, commit)
                            : solve_from(old_ ? &*old_ : nullptr, affected_, now->problem, options,
                                         limits, observer);
    kept_ = std::move(now);
    if (solution.plan) {
      plan_ = old_ = solution.plan;
      affected_.assign(affected_.size(), false);
      cut_.clear();
    }
    return solution;
  }

 private:
  void require_open(Time commit) const {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      const Time end = static_cast<Time>(old_->agents[agent].path.size()) - 1;
      if (!cut_.empty() && cut_[agent] && end < commit) throw NotCommitted(agent, end);
    }
  }

  Solution solve_later(const Kept& now, const SolveOptions& options, const Limits& limits,
                       RunObserver& observer, Time commit) {
    require_open(commit);
    std::optional<Remainder> rest;
    try {
      rest = grove::detail::advance(instance_, *old_, commit, Rests::kWhereItMust);
    } catch (const InstanceError& error) {
      return unknown(options, error.what());
    }
    const Kept later(std::move(rest->instance), limits, options.threads, &now);
    AgentStopsStore stops(now.instance, now.problem.distances);
    const Cost own_costs = sum_of_own_costs(now.problem, stops, limits);
    WholePlans plans(observer, instance_, *old_, commit, later.instance, own_costs);
    Solution solution = solve_from(&rest->plan, affected_, later.problem, options, limits, plans);
    return plans.whole(std::move(solution));
  }

  Instance instance_;
  std::optional<Plan> plan_;    // valid
  std::optional<Plan> old_;     // valid but for who is affected
  std::vector<bool> affected_;  // by agent
  std::vector<bool> cut_;       // by agent: its path comes to what is closed; empty: nobody's
  std::unique_ptr<Kept> kept_;
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
void Session::advance(Time steps, std::span<const Late> late) {
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
