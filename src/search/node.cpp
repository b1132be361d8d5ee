// SPDX-License-Identifier: MIT
#include "grove/search/node.h"

#include <algorithm>
#include <utility>

namespace grove {
namespace {

Cost cost_of_root(const Tree& tree) {
  Cost cost = 0;
  for (const auto& order : tree.orders) cost += order->path.cost();
  return cost;
}

}  // namespace

NodePtr Node::root(const Tree& tree) {
  const Cost cost = cost_of_root(tree);
  void* memory = tree.pool->allocate(bytes(0));
  return NodePtr(new (memory) Node(nullptr, tree, cost, cost, AgentConstraint(), 0));
}

NodePtr Node::child(const NodePtr& parent, const Grid& grid, const AgentConstraint& added,
                    const Path& path, Cost cost) {
  const Tree& tree = parent->tree();
  const auto steps = static_cast<std::uint32_t>(path.size() - 1);
  void* memory = tree.pool->allocate(bytes(steps));
  const Cost bound = std::max(parent->bound(), cost);
  Node* node = new (memory) Node(parent, tree, bound, cost, added, steps);
  pack(grid, path, reinterpret_cast<std::uint64_t*>(node + 1));
  return NodePtr(node);
}

// A chain of ancestors that nobody else holds is released in a loop: recursion would need a stack
// as deep as the tree.
void Node::release(const Node* node) {
  while (node && node->references_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
    const Node* parent = node->parent_.get();
    node->parent_.abandon();
    NodePool& pool = *node->tree_->pool;
    const std::size_t size = bytes(node->steps_);
    node->~Node();
    pool.release(const_cast<Node*>(node), size);
    node = parent;
  }
}

void Node::paths(const Problem& problem, std::vector<Path>& paths) const {
  const Instance& instance = problem.instance;
  paths.resize(instance.agent_count());
  for (Path& path : paths) path.clear();
  const auto unpack = [&](const PackedSteps& packed, AgentIndex agent) {
    if (paths[agent].empty())
      packed.unpack(instance.grid(), instance.agent(agent).start, paths[agent]);
  };
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    unpack(node->path(), node->added_.agent);
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    unpack(tree_->orders[agent]->path.view(), agent);
}

void Node::constraints(AgentIndex agent, std::vector<Constraint>& constraints) const {
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    if (node->added_.agent == agent) constraints.push_back(node->added_.constraint);
}

std::vector<TaskIndex> tasks_in_order(const Agent& agent, const Sequence& sequence) {
  std::vector<TaskIndex> tasks;
  for (Stop stop : sequence) tasks.push_back(agent.tasks[stop]);
  return tasks;
}

}  // namespace grove
