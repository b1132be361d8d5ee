// SPDX-License-Identifier: MIT
// The cost of a root is the first lower bound of its tree. A record from outside is therefore
// checked: each path must take the least time for the order in which it visits its stops. For a
// fixed order this proves the bound again. Usually the distances decide the question; where agents
// turn, distances can be too small, and a search decides.
#include "search/tree_record.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "planning/fixed_order_sipp.h"
#include "search/require.h"

namespace grove::detail {
namespace {

TreeRecord::Order record_of(const World& world, const AgentSequencing& order) {
  const PackedSteps path = order.path.view();
  return {order.sequences, order.goals.has_value(), path.steps,
          std::vector(path.words, path.words + packed_words(world, path.steps))};
}

bool is_complete(const Sequence& sequence, const Agent& agent) {
  std::vector<bool> seen(agent.stops.size());
  for (const Stop stop : sequence) {
    if (stop >= seen.size() || seen[stop]) return false;
    seen[stop] = true;
  }
  return sequence.size() == seen.size();
}

bool visits_in_turn(const Path& path, const GoalSequence& goals) {
  auto now = path.begin();
  for (int k = 0; k < goals.size(); ++k) {
    now = std::find_if(now, path.end(), [&](State state) { return goals.to_goal(k)[state] == 0; });
    if (now == path.end()) return false;
  }
  return goals.to_goal(goals.size() - 1)[path.back()] == 0;
}

Path path_of(const TreeRecord::Order& record, const Instance& instance, AgentIndex agent) {
  const State start = instance.agent(agent).start;
  require(record.words.size() == packed_words(instance.world(), record.steps),
          "a tree's path must have the length it claims");
  const PackedSteps steps{record.steps, record.words.data()};
  require(steps.is_walk(instance.world(), start),
          "a tree's path must be a walk on the map from its agent's start");
  Path path;
  steps.unpack(instance.world(), start, path);
  return path;
}

}  // namespace

TreeRecord record_of(const Tree& tree) {
  TreeRecord record;
  for (const auto& order : tree.orders) record.orders.push_back(record_of(*tree.world, *order));
  return record;
}

Trees::Trees(const Problem& problem, AgentStopsCache& stops, NodePool& pool)
    : problem_(problem), stops_(stops), pool_(pool), orders_(problem.instance.agent_count()) {}

NodePtr Trees::add(const TreeRecord& record, std::uint32_t number) {
  require(record.orders.size() == orders_.size(),
          "a tree must fix as many agents' orders as the instance has agents");
  Tree tree{&problem_.instance.world(), &pool_, number, {}};
  for (std::size_t agent = 0; agent < orders_.size(); ++agent)
    tree.orders.push_back(order_of(static_cast<AgentIndex>(agent), record.orders[agent]));
  NodePtr root = Node::root(trees_.emplace_back(std::move(tree)));
  Cost steps = 0;
  for (const TreeRecord::Order& order : record.orders) steps += order.steps;
  GROVE_CHECK(root->cost() == steps, "the root of a tree costs as much as its record");
  return root;
}

Trees::Order Trees::order_of(AgentIndex agent, const TreeRecord::Order& record) {
  auto& known = orders_[agent];
  const auto same = [&](const Order& order) {
    return order->sequences == record.sequences &&
           record_of(problem_.instance.world(), *order) == record;
  };
  const auto found = std::ranges::find_if(known, same);
  if (found != known.end()) return *found;
  return known.emplace_back(std::make_shared<const AgentSequencing>(made(agent, record)));
}

// Least cost of a path through the goals; kNever if there is none. `known` is the cost of a known
// path; it is returned without a search if the distances prove that it is the least.
Time Trees::min_cost(const GoalSequence& goals, std::uint32_t known) {
  const Time distance = goals.distance(goals.start(), 0);
  if (distance == static_cast<Time>(known)) return distance;
  FixedOrderSipp search(problem_.instance.world());
  Path path;
  const auto outcome = search.find(goals, {}, Limits(), path);
  return outcome == PathOutcome::kFound ? static_cast<Time>(path.size()) - 1 : kNever;
}

AgentSequencing Trees::made(AgentIndex agent, const TreeRecord::Order& record) {
  const Instance& instance = problem_.instance;
  const Path path = path_of(record, instance, agent);
  if (record.fixed)
    require(is_complete(record.sequences.prefix, instance.agent(agent)) &&
                record.sequences.forbidden_next == 0,
            "a fixed order must hold every stop of its agent once");
  GoalSequence goals = goals_in_order(
      problem_, agent,
      record.fixed ? record.sequences.prefix
                   : realized_sequence(SequenceStages(stops_.of(agent), record.sequences), path));
  require(visits_in_turn(path, goals), "a tree's path must visit its agent's stops in order");
  require(static_cast<Time>(record.steps) == min_cost(goals, record.steps),
          "a tree's path must be shortest in its order of stops");
  return {record.sequences, record.fixed ? std::optional(std::move(goals)) : std::nullopt,
          PackedPath(instance.world(), path)};
}

}  // namespace grove::detail
