// SPDX-License-Identifier: MIT
#include "assignment/choice_neighborhoods.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "assignment/route_costs.h"

namespace grove::detail {
namespace {

constexpr int kFirstFreeAgents = 3;
constexpr int kDrawsPerCall = 10;
constexpr std::int64_t kImproveEffort = 300'000;  // scanned legs

// The assignment without visits that exceed the needs of tasks.
Assignment needed_visits(const Instance& instance, Assignment assignment) {
  std::vector<int> visits(instance.tasks().size());
  for (AgentChoice& choice : assignment)
    std::erase_if(choice.visits,
                  [&](TaskIndex task) { return ++visits[task] > instance.task(task).need; });
  return assignment;
}

std::vector<TaskIndex> merged(const std::vector<TaskIndex>& a, const std::vector<TaskIndex>& b) {
  std::vector<TaskIndex> both;
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

}  // namespace

ChoiceNeighborhoods::ChoiceNeighborhoods(const Instance& instance, const Routes& routes,
                                         const RouteBound& bound, std::uint64_t seed)
    : instance_(instance), costs_(routes.costs()), bound_(bound), random_(seed) {}

void ChoiceNeighborhoods::start_from(const Plan& plan, const Limits& limits) {
  assignment_ = needed_visits(instance_, assignment_of(instance_, plan));
  cutoff_ = plan.cost;
  is_possible_ = bound_.fix(cutoff_, limits) && bound_.is_feasible();
  free_agents_ = std::min(kFirstFreeAgents, instance_.agent_count());
  drawn_ = 0;
  known_.clear();
}

RouteBound* ChoiceNeighborhoods::next(const Limits& limits) {
  for (int draw = 0; draw < kDrawsPerCall && is_possible_; ++draw) {
    if (limits.stop_requested()) return nullptr;
    const std::vector<AgentIndex> free = draw_agents();
    grow();
    if (!known_.insert(free).second) continue;
    current_ = std::make_unique<RouteBound>(bound_);
    current_->restrict_to(choices_of(free));
    if (!current_->is_feasible()) continue;
    current_->improve(kImproveEffort, limits);
    if (current_->lower_bound() >= cutoff_ || !current_->fix(cutoff_, limits)) continue;
    if (current_->is_feasible()) return current_.get();
  }
  return nullptr;
}

// After as many draws as there are agents, more agents are free.
void ChoiceNeighborhoods::grow() {
  const bool are_all_free = free_agents_ == instance_.agent_count();
  if (++drawn_ < instance_.agent_count() && !are_all_free) return;
  drawn_ = 0;
  ++free_agents_;
  is_possible_ = !are_all_free;
}

// A random agent and those near its route, in ascending order.
std::vector<AgentIndex> ChoiceNeighborhoods::draw_agents() {
  const AgentIndex first = random_.below(instance_.agent_count());
  std::vector<std::pair<double, AgentIndex>> order;
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    const double noise = 0.5 + random_.unit();
    order.emplace_back(agent == first ? -1 : noise * static_cast<double>(distance(agent, first)),
                       agent);
  }
  std::ranges::partial_sort(order, order.begin() + free_agents_);
  std::vector<AgentIndex> agents;
  for (int i = 0; i < free_agents_; ++i)
    agents.push_back(order[static_cast<std::size_t>(i)].second);
  std::ranges::sort(agents);
  return agents;
}

// The least cost of a leg from the start or an optional task of one of the two agents to an
// optional task of the other.
std::int64_t ChoiceNeighborhoods::distance(AgentIndex from, AgentIndex to) const {
  std::int64_t least = kNever;
  for (const TaskIndex task : assignment_[to].visits) {
    least = std::min<std::int64_t>(least, costs_.from_start(from, task));
    for (const TaskIndex other : assignment_[from].visits)
      least = std::min<std::int64_t>(least, costs_.between(from, other, task));
  }
  for (const TaskIndex task : assignment_[from].visits)
    least = std::min<std::int64_t>(least, costs_.from_start(to, task));
  return least;
}

std::vector<RouteChoices> ChoiceNeighborhoods::choices_of(
    const std::vector<AgentIndex>& free) const {
  const auto is_free = [&](AgentIndex agent) { return std::ranges::binary_search(free, agent); };
  std::vector<bool> is_exchanged(instance_.tasks().size());  // by task: between free agents
  std::vector<bool> must_change(instance_.tasks().size());   // no cheaper plan has its visits
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
    for (const TaskIndex task : assignment_[agent].visits) {
      if (is_free(agent)) is_exchanged[task] = true;
      if (!std::ranges::binary_search(bound_.choices()[agent].visits, task))
        must_change[task] = true;
    }
  std::vector<RouteChoices> choices = bound_.choices();
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    RouteChoices& own = choices[agent];
    const AgentChoice& of_plan = assignment_[agent];
    std::erase_if(own.visits, [&](TaskIndex task) {
      const bool may_take = must_change[task] || (is_free(agent) && is_exchanged[task]);
      return !may_take && !std::ranges::binary_search(of_plan.visits, task) &&
             !std::ranges::binary_search(own.required, task);
    });
    if (is_free(agent)) continue;
    std::vector<TaskIndex> kept;
    std::ranges::set_intersection(own.visits, of_plan.visits, std::back_inserter(kept));
    own.required = merged(own.required, kept);
    if (of_plan.goal && std::ranges::count(own.goals, *of_plan.goal) > 0)
      own.goals = {*of_plan.goal};
  }
  return choices;
}

}  // namespace grove::detail
