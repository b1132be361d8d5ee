// SPDX-License-Identifier: MIT
// LaCAM (Okumura, AAAI 2023) over configurations of (state, stops left) per agent, with PIBT as the
// configuration generator.
//
// *Search.* Depth first and lazy: each expansion of the configuration on top of the stack generates
// one successor, under the next node of the configuration's constraint tree. This tree is searched
// breadth first. Its root constrains no agent. The children of a node at depth d constrain the
// agent of priority d + 1, each to one of the states that it can enter. Therefore the first
// successors are those that PIBT prefers, and the leaves, which constrain every agent, enumerate
// all successors. A configuration leaves the stack only when its constraint tree is exhausted, so
// in the end every reachable configuration is expanded. A successor that was generated before is
// pushed again if its tree is not exhausted (as in LaCAM*, IJCAI 2023), which leads out of loops.
//
// *Stops.* In contrast to the original LaCAM, agents have stops. An agent that is on a stop has
// visited it, whatever the order. The remaining stops are part of the configuration. The order in
// which an agent *heads* for its stops only determines PIBT's preferences, so the search is
// exhaustive under any order, with one exception: if an agent, even without the other agents,
// cannot visit its stops in its order, the search ends at once. Where every step can be undone this
// loses no plan, because stops that can be visited in one order can be visited in any other. With
// one-way moves a plan with a different order can exist.
//
// *Guide.* A guide (traffic_guided_lacam.cpp) leads nearly all agents to their destinations, but
// the last ones can move in circles, each making way for the other. On warehouse-10-20-10-2-1 with
// 900 agents, 36 agents had not arrived after 204 steps, nor after 3,800. Therefore distances in
// steps replace the guide as soon as a configuration is generated a second time.
//
// *No destination.* An agent without a destination heads for one of its stops to rest there, but a
// configuration is a goal wherever the agent rests.
//
// *Priority.* The more joint steps ago an agent could last rest, the earlier it chooses. Ties are
// broken by distance at the start, longest first. Agents that may rest where they are choose last.
// If they make way, counting starts again. (Counting steps from the last visited stop instead gives
// plans that cost 6 % more on the dense instances below, and fails more often on the densest. With
// the longest *remaining* distance first, plans cost four times as much.)
//
// *Measured* with the restarts of lacam_with_restarts.cpp on one core, on scenarios 1-5 of Moving
// AI maps with 3 seeds each (agents/tasks). All runs found a plan. Costs are multiples of the cost
// of the cheapest sequences without conflicts.
//
//                           ms, median and worst   cost, median
//   room-32-32-4 120/120         2      2              1.73
//   random-32-32-20 250/250      5      7              2.04
//   random-32-32-20 400/400     43    310              3.45    (half of all cells)
//   random-64-64-10 200/600      9     14              1.14
//   room-64-64-8 200/600        14     20              1.40
//   den312d 200/600             14     23              1.31
//
// Without swaps.cpp, only 7 of 10 runs on random-32-32-20 250/250 ended within 0.5 s.
#include "primal/lacam.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "model/plan.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMemoryToSpare = 1 << 20;

std::vector<VisitStages> visit_stages(const Problem& problem, std::span<const Sequence> orders,
                                      const LegFields* guide) {
  const int agents = problem.instance.agent_count();
  if (orders.size() != static_cast<std::size_t>(agents))
    throw std::invalid_argument("every agent needs an order");
  std::vector<VisitStages> states;
  for (AgentIndex agent = 0; agent < agents; ++agent)
    states.emplace_back(problem, agent, orders[agent], guide);
  return states;
}

}  // namespace

Lacam::Lacam(const Problem& problem, std::span<const Sequence> orders, std::uint64_t seed,
             const LegFields* guide)
    : instance_(problem.instance),
      agents_(visit_stages(problem, orders, guide)),
      dice_(seed),
      generator_(instance_.world(), agents_),
      configurations_(instance_.agent_count()),
      ages_(agents()),
      is_guided_(guide != nullptr),
      places_(agents()) {
  start(problem);
}

void Lacam::start(const Problem& problem) {
  std::vector<Time> ways;
  for (std::size_t i = 0; i < agents(); ++i) {
    const State start = problem.instance.agent(static_cast<AgentIndex>(i)).start;
    places_[i] = {start, agents_[i].first()};
    ways.push_back(agents_[i].distance(places_[i].stage, start));
  }
  if (std::ranges::any_of(ways, [](Time way) { return way >= kNever; })) return;
  std::vector<AgentIndex>& by_distance = ranking_.by_distance;
  by_distance.resize(agents());
  std::iota(by_distance.begin(), by_distance.end(), 0);
  std::ranges::stable_sort(by_distance, std::greater(), [&](AgentIndex i) { return ways[i]; });
  add_node(configurations_.insert(places_), -1);
}

Lacam::Outcome Lacam::run(const Limits& limits, std::int64_t& steps) {
  for (; !plan_; --steps) {
    if (stack_.empty()) return Outcome::kExhausted;
    if (steps <= 0) return Outcome::kWorking;
    if (limits.stop_requested() || !has_room(limits)) return Outcome::kStopped;
    expand(stack_.back());
  }
  return Outcome::kFound;
}

// True if there is memory for the next expansion. Tested before the allocation, because this search
// must not end the run for lack of memory.
bool Lacam::has_room(const Limits& limits) const {
  const auto growth = [](const auto& vector, std::size_t more) {
    return vector.size() + more > vector.capacity() ? 2 * vector.capacity() * sizeof(vector[0]) : 0;
  };
  const std::size_t bytes = configurations_.growth() + ages_.growth() + growth(nodes_, 1) +
                            growth(constraints_, 5) + growth(stack_, 1);
  // Requires twice the growth, because memory granted before is possibly not in use yet.
  return bytes == 0 || limits.memory_allows(2 * bytes + kMemoryToSpare);
}

void Lacam::add_constraint(Id id, ConstraintId above, State state, std::int32_t depth) {
  const auto added = static_cast<ConstraintId>(constraints_.size());
  constraints_.push_back({above, kNone, state, depth});
  Node& node = nodes_[id];
  (node.first == kNone ? node.first : constraints_[node.last].next) = added;
  node.last = added;
}

Lacam::ConstraintId Lacam::take_constraint(Id id) {
  GROVE_ASSERT(nodes_[id].first != kNone, "only a configuration with constraints left is expanded");
  return std::exchange(nodes_[id].first, constraints_[nodes_[id].first].next);
}

void Lacam::expand(Id id) {
  if (nodes_[id].first == kNone) {
    stack_.pop_back();
    return;
  }
  rank_agents(id);
  const ConstraintId constraint = take_constraint(id);
  branch(id, constraint);
  collect_constraints(constraint);
  const auto states = generator_.step(configurations_[id], ranking_.agents, orders_, dice_);
  if (!states.empty()) arrive(id, states);
}

void Lacam::rank_agents(Id id) {
  if (ranking_.of == id) return;
  ranking_.of = id;
  ranking_.agents = ranking_.by_distance;
  const std::span<const Age> ages = ages_[id];
  std::ranges::stable_sort(ranking_.agents, std::greater(), [&](AgentIndex i) { return ages[i]; });
}

void Lacam::branch(Id id, ConstraintId constraint) {
  const std::int32_t depth = constraints_[constraint].depth;
  GROVE_ASSERT(ranking_.of == id, "constraints follow the ranking of their configuration");
  if (depth == static_cast<std::int32_t>(agents())) return;
  const AgentIndex agent = ranking_.agents[depth];
  const AgentState from = configurations_[id][agent];
  next_.assign(1, from.state);
  for (const State state : instance_.world().moves(from.state))
    if (agents_[agent].may_enter(from.stage, state)) next_.push_back(state);
  for (auto count = static_cast<std::uint32_t>(next_.size()); count > 0; --count) {
    std::swap(next_[count - 1], next_[dice_.below(count)]);
    add_constraint(id, constraint, next_[count - 1], depth + 1);
  }
}

void Lacam::collect_constraints(ConstraintId constraint) {
  orders_.clear();
  for (; constraints_[constraint].depth > 0; constraint = constraints_[constraint].above)
    orders_.push_back(
        {ranking_.agents[constraints_[constraint].depth - 1], constraints_[constraint].state});
  GROVE_ASSERT(orders_.empty() || orders_.back().agent == ranking_.agents.front(),
               "the constraints of a node begin with the agent of highest priority");
}

void Lacam::arrive(Id from, std::span<const State> states) {
  const auto before = configurations_[from];
  for (std::size_t i = 0; i < agents(); ++i)
    places_[i] = {states[i], agents_[i].after(before[i].stage, states[i])};
  const Id known = configurations_.count();
  const Id id = configurations_.insert(places_);
  if (id == known) {
    add_node(id, from);
    return;
  }
  if (is_guided_) leave_guide();
  if (id != from && nodes_[id].first != kNone) stack_.push_back(id);
}

void Lacam::leave_guide() {
  is_guided_ = false;
  for (VisitStages& agent : agents_) agent.go_by_steps();
}

void Lacam::add_node(Id id, Id parent) {
  nodes_.push_back({parent, kNone, kNone});
  const std::span<Age> ages = ages_.add();
  for (std::size_t i = 0; i < agents(); ++i) ages[i] = age_of(i, parent, places_[i]);
  GROVE_ASSERT(id + 1 == configurations_.count() && std::ssize(nodes_) == configurations_.count() &&
                   ages_.count() == configurations_.count(),
               "each configuration has one node and one row of ages");
  add_constraint(id, kNone, kNoState, 0);
  stack_.push_back(id);
  if (is_end(id)) plan_ = make_plan(id);
}

Lacam::Age Lacam::age_of(std::size_t agent, Id parent, AgentState place) {
  if (at_rest(agent, place)) return kArrived;
  return parent < 0 ? 1 : std::min<Age>(kOldest - 1, ages_[parent][agent]) + 1;
}

bool Lacam::is_end(Id id) {
  return std::ranges::all_of(ages_[id], [](Age age) { return age == kArrived; });
}

Plan Lacam::make_plan(Id end) {
  std::vector<Id> way;
  for (Id id = end; id >= 0; id = nodes_[id].parent) way.push_back(id);
  std::ranges::reverse(way);
  GROVE_CHECK(way.front() == 0, "a plan begins at the start configuration");
  Plan plan;
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    Path path;
    for (Id id : way) path.push_back(configurations_[id][agent].state);
    plan.agents.push_back(plan_of_path(instance_, agent, path));
    plan.cost += plan.agents.back().cost;
  }
  return plan;
}

}  // namespace grove::detail
