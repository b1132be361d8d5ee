// SPDX-License-Identifier: MIT
// A second, independent implementation of the definition of a valid plan (docs/design.md, section
// 1). The code is direct rather than clever, so that it can be compared with that section line by
// line. It checks, in this order:
// - Each agent by itself (agent_check.cpp): places, start, steps, task executions, end, visits,
//   sequence, cost.
// - Collisions: all agents advance step by step, on a table with the agent on each place. The
//   effort is O(agents * time), instead of O(agents^2 * time) for comparing all pairs of paths.
// - Needs: each task is visited by as many agents as it needs.
// - Claims: the plan's cost is the sum of the agents' finish times, the lower bound is from 0 to
//   this sum, and the status follows from cost, lower bound and omega.
// Collisions and claims are not checked if check_agent() returns nullopt for an agent.
#include "model/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "model/agent_check.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

// Checks for collisions by advancing all agents step by step. Precondition: check_agent() returned
// a finish time for every agent.
class CollisionCheck {
 public:
  CollisionCheck(const Instance& instance, const AllowedSteps& steps, const Plan& plan,
                 bool may_follow, ViolationReport& report)
      : instance_(instance),
        steps_(steps),
        plan_(plan),
        may_follow_(may_follow),
        report_(report),
        before_(static_cast<std::size_t>(steps.places()), kNoAgent),
        now_(static_cast<std::size_t>(steps.places()), kNoAgent) {}

  void run() {
    std::size_t end = 0;
    for (const AgentPlan& agent : plan_.agents) end = std::max(end, agent.path.size());
    for (std::size_t t = 0; t < end && !report_.full(); ++t) {
      for (AgentIndex i = 0; i < agent_count(); ++i) enter(i, t);
      if (t > 0)
        for (AgentIndex i = 0; i < agent_count(); ++i) check_swap(i, t);
      if (t > 0 && !may_follow_)
        for (AgentIndex i = 0; i < agent_count(); ++i) check_following(i, t);
      if (t > 0)
        for (AgentIndex i = 0; i < agent_count(); ++i) before_[at(i, t - 1)] = kNoAgent;
      std::swap(before_, now_);
    }
    GROVE_ASSERT(std::ranges::count(now_, kNoAgent) == std::ssize(now_),
                 "the table is empty before agents enter it");
  }

 private:
  static constexpr AgentIndex kNoAgent = -1;

  AgentIndex agent_count() const { return static_cast<AgentIndex>(plan_.agents.size()); }

  Place at(AgentIndex agent, std::size_t time) const {
    const Path& path = plan_.agents[agent].path;
    return instance_.pose_of(path[std::min(time, path.size() - 1)]).place;
  }

  void enter(AgentIndex agent, std::size_t t) {
    const Place place = at(agent, t);
    const AgentIndex other = std::exchange(now_[place], agent);
    if (other != kNoAgent && is_new(vertex_pairs_, other, agent))
      report_.add(where(agent, t), "agents '{}' and '{}' are both on {} at time {}", id(other),
                  id(agent), steps_.name(place), t);
  }

  void check_swap(AgentIndex agent, std::size_t t) {
    const Place from = at(agent, t - 1);
    const Place to = at(agent, t);
    const AgentIndex other = before_[to];
    if (from == to || other == kNoAgent || other == agent || at(other, t) != from) return;
    if (is_new(edge_pairs_, other, agent))
      report_.add(where(agent, t), "agents '{}' and '{}' swap {} and {} between times {} and {}",
                  id(agent), id(other), steps_.name(from), steps_.name(to), t - 1, t);
  }

  void check_following(AgentIndex agent, std::size_t t) {
    const Place to = at(agent, t);
    const AgentIndex other = before_[to];
    if (other == kNoAgent || other == agent || at(other, t) == to) return;
    if (is_new(following_pairs_, other, agent))
      report_.add(where(agent, t),
                  "agent '{}' enters {} at time {}, as '{}' leaves it; expected no following",
                  id(agent), steps_.name(to), t, id(other));
  }

  const std::string& id(AgentIndex agent) const { return instance_.agent(agent).id; }

  std::string where(AgentIndex agent, std::size_t t) const {
    return fmt::format("/agents/{}/path/{}", agent,
                       std::min(t, plan_.agents[agent].path.size() - 1));
  }

  using Pairs = std::set<std::pair<AgentIndex, AgentIndex>>;
  // Adds the pair to `pairs`, which contains the pairs with a collision of one type. Returns true
  // if it is new. Only the first collision of a type is reported for a pair, because agents that
  // collide often do so in many steps.
  static bool is_new(Pairs& pairs, AgentIndex a, AgentIndex b) {
    return pairs.insert(std::minmax(a, b)).second;
  }

  const Instance& instance_;
  const AllowedSteps& steps_;
  const Plan& plan_;
  const bool may_follow_;
  ViolationReport& report_;
  std::vector<AgentIndex> before_;  // by place: the agent that was there at time t - 1
  std::vector<AgentIndex> now_;
  Pairs vertex_pairs_;
  Pairs edge_pairs_;
  Pairs following_pairs_;
};

// Checks each agent by itself. Returns the sum of the finish times. Returns nullopt if
// check_agent() returns nullopt for an agent.
std::optional<Cost> check_agents(const Instance& instance, const AllowedSteps& steps,
                                 const Plan& plan, ViolationReport& report) {
  std::optional<Cost> total = 0;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const auto finish = check_agent(instance, steps, i, plan.agents[i], report);
    if (!finish) total.reset();
    if (total) *total += *finish;
  }
  return total;
}

// Checks that each task with a choice of agents is visited by as many different agents as it needs.
// (A task that needs all its agents is checked agent by agent.)
void check_needs(const Instance& instance, const Plan& plan, ViolationReport& report) {
  std::vector<std::set<AgentIndex>> visitors(instance.tasks().size());
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    for (const WorkTime& work : plan.agents[i].work) visitors[work.task].insert(i);
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const Task& task = instance.task(i);
    const std::size_t need = static_cast<std::size_t>(task.need);
    if (need < task.agents.size() && visitors[i].size() < need)
      report.add("/agents", "task '{}' is visited by {} of its agents; expected at least {}",
                 task.id, visitors[i].size(), need);
  }
}

// The status that follows from a plan's cost and the claimed lower bound. Precondition: lower_bound
// <= cost.
Status deserved_status(Cost cost, Cost lower_bound, Omega omega) {
  if (cost == lower_bound) return Status::kOptimal;
  const bool within = !omega.is_infinite() && omega.accepts(cost, lower_bound);
  return within ? Status::kBounded : Status::kFeasible;
}

void check_claims(const Solution& solution, Cost cost, ViolationReport& report) {
  if (solution.plan->cost != cost)
    report.add("/cost", "the agents' costs add up to {}, but the plan claims {}", cost,
               solution.plan->cost);
  if (solution.lower_bound < 0)
    report.add("/lower_bound", "found {}; expected at least 0", solution.lower_bound);
  if (solution.lower_bound > cost)
    report.add("/lower_bound", "found {}; expected at most {}, the cost of this plan",
               solution.lower_bound, cost);
  const Status deserved = deserved_status(cost, solution.lower_bound, solution.omega);
  if (solution.lower_bound <= cost && solution.status != deserved)
    report.add("/status", "found '{}'; expected '{}' with cost {}, lower bound {} and omega {}",
               to_string(solution.status), to_string(deserved), cost, solution.lower_bound,
               solution.omega.to_string());
}

// The plan, with the lower bound 0.
Solution solution_with(Plan plan) {
  Solution solution;
  solution.status = status_of(plan.cost, solution.lower_bound, solution.omega);
  solution.plan = std::move(plan);
  return solution;
}

}  // namespace

std::vector<Violation> check(const Instance& instance, const Solution& solution,
                             std::size_t limit) {
  ViolationReport report(std::max<std::size_t>(limit, 1));
  if (!solution.plan) {
    report.add("/status", "there is no plan ('{}'); expected a path for every agent",
               to_string(solution.status));
    return report.take();
  }
  const Plan& plan = *solution.plan;
  if (plan.agents.size() != static_cast<std::size_t>(instance.agent_count())) {
    report.add("/agents", "the plan has {} agents; expected {}", plan.agents.size(),
               instance.agent_count());
    return report.take();
  }
  const AllowedSteps steps(instance.map());
  if (const auto cost = check_agents(instance, steps, plan, report)) {
    CollisionCheck(instance, steps, plan, instance.may_follow() && solution.may_follow, report)
        .run();
    check_needs(instance, plan, report);
    check_claims(solution, *cost, report);
  }
  return report.take();
}

void require_valid_plan(const Instance& instance, const Solution& solution) {
  if (!solution.plan) return;
  std::vector<Violation> wrong = check(instance, solution, 1);
  if (!wrong.empty()) throw InvalidPlan(std::move(wrong.front()));
}

void require_valid_plan(const Instance& instance, const Plan& plan) {
  require_valid_plan(instance, solution_with(plan));
}

Plan checked_plan(const Instance& instance, Plan plan) {
  Solution claim = solution_with(std::move(plan));
  if (const auto violations = check(instance, claim, 1); !violations.empty())
    throw std::logic_error(fmt::format("internal error: a plan of the search is wrong at {}: {}",
                                       violations[0].json_pointer, violations[0].message));
  return *std::move(claim.plan);
}

}  // namespace grove::detail
