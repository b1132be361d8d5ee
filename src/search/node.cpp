// SPDX-License-Identifier: MIT
#include "search/node.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace grove::detail {
namespace {

Cost cost_of_root(const Tree& tree) {
  Cost cost = 0;
  for (const auto& order : tree.orders) cost += order->path.cost();
  return cost;
}

// True if each of `paths` is of a different agent of `tree`, and none is empty.
bool are_of_distinct_agents(std::span<const NewPath> paths, const Tree& tree) {
  return std::ranges::all_of(paths, [&](const NewPath& path) {
    return path.agent >= 0 && path.agent < std::ssize(tree.orders) && !path.path->empty() &&
           std::ranges::count(paths, path.agent, &NewPath::agent) == 1;
  });
}

}  // namespace

NodePtr Node::root(const Tree& tree) {
  NodeDelta change;
  change.cost = change.bound = cost_of_root(tree);
  void* memory = tree.pool->allocate(bytes(*tree.world, change.paths));
  return NodePtr(new (memory) Node(nullptr, tree, change));
}

NodePtr Node::child(const NodePtr& parent, const NodeDelta& change) {
  const Tree& tree = parent->tree();
  const World& world = *tree.world;
  GROVE_ASSERT(are_of_distinct_agents(change.paths, tree),
               "a node stores at most one path of each agent of its tree");
  void* memory = tree.pool->allocate(bytes(world, change.paths));
  Node* node = new (memory) Node(parent, tree, change);
  node->bound_ = std::max({change.bound, change.cost, parent->bound()});
  auto* word = reinterpret_cast<std::uint64_t*>(node + 1);
  for (const NewPath& path : change.paths) {
    const auto steps = static_cast<std::uint32_t>(path.path->size() - 1);
    *word++ = std::bit_cast<std::uint64_t>(PathHead{path.agent, steps});
    pack(world, *path.path, word);
    word += packed_words(world, steps);
  }
  GROVE_ASSERT(node->bound_ >= parent->bound() && node->bound_ >= node->cost_,
               "a node's bound is at least its parent's and at least its cost");
  GROVE_ASSERT(node->bytes() == bytes(world, change.paths), "a node knows its size");
  return NodePtr(node);
}

std::size_t Node::bytes(const World& world, std::span<const NewPath> paths) {
  std::size_t words = paths.size();
  for (const NewPath& path : paths)
    words += packed_words(world, static_cast<std::uint32_t>(path.path->size() - 1));
  return sizeof(Node) + words * sizeof(std::uint64_t);
}

std::size_t Node::bytes() const {
  std::size_t words = path_count_;
  for_each_path([&](AgentIndex, const PackedSteps& path) {
    words += packed_words(*tree_->world, path.steps);
  });
  return sizeof(Node) + words * sizeof(std::uint64_t);
}

// Releases the node and then, in a loop, ancestors that have no other owner. Recursion would need a
// stack as deep as the tree.
void Node::release(const Node* node) {
  while (node && node->references_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
    const Node* parent = node->parent_.get();
    node->parent_.abandon();
    NodePool& pool = *node->tree_->pool;
    const std::size_t size = node->bytes();
    node->~Node();
    pool.release(const_cast<Node*>(node), size);
    node = parent;
  }
}

void Node::paths(const Problem& problem, std::vector<Path>& paths) const {
  std::vector<AgentIndex> all(static_cast<std::size_t>(problem.instance.agent_count()));
  std::iota(all.begin(), all.end(), 0);
  this->paths(problem, all, paths);
}

void Node::paths(const Problem& problem, std::span<const AgentIndex> agents,
                 std::vector<Path>& paths) const {
  const Instance& instance = problem.instance;
  paths.resize(instance.agent_count());
  for (Path& path : paths) path.clear();
  std::vector<bool> wanted(paths.size());
  for (AgentIndex agent : agents) wanted[agent] = true;
  const auto unpack = [&](AgentIndex agent, const PackedSteps& packed) {
    if (wanted[agent] && paths[agent].empty())
      packed.unpack(instance.world(), instance.agent(agent).start, paths[agent]);
  };
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    node->for_each_path(unpack);
  for (AgentIndex agent : agents) unpack(agent, tree_->orders[agent]->path.view());
  GROVE_ASSERT(std::ranges::all_of(agents,
                                   [&](AgentIndex agent) {
                                     return !paths[agent].empty() &&
                                            paths[agent].front() == instance.agent(agent).start;
                                   }),
               "each agent has a path from its start at every node");
}

void Node::constraints(AgentIndex agent, std::vector<Constraint>& constraints) const {
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    if (const auto constraint = constraint_on(agent, node->added_))
      constraints.push_back(*constraint);
}

void Node::constraints(std::vector<std::vector<Constraint>>& constraints) const {
  constraints.resize(tree_->orders.size());
  for (auto& list : constraints) list.clear();
  std::vector<AgentIndex> agents(constraints.size());
  std::iota(agents.begin(), agents.end(), AgentIndex{0});
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    for_each_implied_constraint(node->added_, agents,
                                [&](AgentIndex agent, const Constraint& constraint) {
                                  constraints[agent].push_back(constraint);
                                });
}

GoalSequence goals_in_order(const Problem& problem, AgentIndex agent, const Sequence& sequence) {
  std::vector<TaskIndex> stops;
  GROVE_ASSERT(sequence.size() == problem.instance.agent(agent).stops.size(),
               "an order of the goals has each stop of its agent");
  for (const Stop stop : sequence) stops.push_back(problem.instance.agent(agent).stops[stop]);
  return GoalSequence(problem.instance, problem.distances, agent, stops);
}

}  // namespace grove::detail
