// SPDX-License-Identifier: MIT
#include "grove/search/node.h"

#include <algorithm>
#include <utility>

namespace grove {
namespace {

Cost cost_of_roots(const Tree& tree) {
  Cost cost = 0;
  for (const auto& order : tree.orders) cost += order->path.cost();
  return cost;
}

}  // namespace

Node::Node(std::shared_ptr<const Tree> tree)
    : tree_(std::move(tree)), bound_(cost_of_roots(*tree_)), cost_(bound_) {}

Node::Node(Ptr parent, const AgentConstraint& added, PackedPath path, Cost cost)
    : parent_(std::move(parent)),
      tree_(parent_->tree_),
      bound_(std::max(parent_->bound_, cost)),
      cost_(cost),
      added_(added),
      path_(std::move(path)) {}

// A chain of ancestors that nobody else holds is released in a loop: recursion would need a stack
// as deep as the tree.
Node::~Node() {
  Ptr next = std::move(parent_);
  while (next && next.use_count() == 1) next = std::move(next->parent_);
}

const PackedPath& Node::path(AgentIndex agent) const {
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    if (node->added_.agent == agent) return node->path_;
  return tree_->orders[agent]->path;
}

void Node::paths(const Problem& problem, std::vector<Path>& paths) const {
  const Instance& instance = problem.instance;
  paths.resize(instance.agent_count());
  for (Path& path : paths) path.clear();
  const auto unpack = [&](const PackedPath& packed, AgentIndex agent) {
    if (paths[agent].empty())
      packed.unpack(instance.grid(), instance.agent(agent).start, paths[agent]);
  };
  for (const Node* node = this; !node->is_root(); node = node->parent_.get())
    unpack(node->path_, node->added_.agent);
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    unpack(tree_->orders[agent]->path, agent);
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

Plan plan_at(const Problem& problem, const Node& node) {
  std::vector<Path> paths;
  node.paths(problem, paths);
  Plan plan;
  for (AgentIndex i = 0; i < problem.instance.agent_count(); ++i) {
    const auto cost = static_cast<Time>(paths[i].size() - 1);
    const Sequence& sequence = node.tree().orders[i]->sequences.prefix;
    plan.cost += cost;
    plan.agents.push_back(
        {cost, tasks_in_order(problem.instance.agent(i), sequence), std::move(paths[i])});
  }
  return plan;
}

}  // namespace grove
