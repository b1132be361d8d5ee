// SPDX-License-Identifier: MIT
// Constraint-tree nodes and the trees they belong to.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grove/conflicts/conflict.h"
#include "grove/model/omega.h"
#include "grove/planning/goal_sequence.h"
#include "grove/search/packed_path.h"
#include "grove/search/problem.h"
#include "grove/sequencing/rtsp.h"

namespace grove {

// What a tree fixes about one agent's order of visits, and the agent's best path when nobody else
// is there. Immutable; shared by all trees that fix the same.
struct AgentOrder {
  SequenceClass sequences;  // the paper's forest: a complete prefix
  GoalSequence goals;
  PackedPath path;  // shortest for `sequences`, no constraints
};

// One tree of the forest: a class of joint task sequences. Immutable, shared by its nodes.
struct Tree {
  std::vector<std::shared_ptr<const AgentOrder>> orders;  // by AgentIndex
};

// A node of a constraint tree (CBS; Sharon et al. 2015): its parent's constraints and one more, and
// the path that this one changed. Immutable once made, so threads may share it; owned by whoever
// holds a NodePtr: the frontier, its children.
class Node {
 public:
  using Ptr = std::shared_ptr<const Node>;

  // The root of `tree`, no constraints.
  explicit Node(std::shared_ptr<const Tree> tree);
  // The child in which `added.agent` obeys one constraint more and takes `path`, `cost` being then
  // the sum of all agents' costs. Its bound is at least its parent's.
  Node(Ptr parent, const AgentConstraint& added, PackedPath path, Cost cost);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // Proven: every plan of the tree that obeys this node's constraints costs at least this.
  Cost bound() const { return bound_; }
  // Sum of the costs of the paths at this node.
  Cost cost() const { return cost_; }
  const Tree& tree() const { return *tree_; }
  bool is_root() const { return !parent_; }

  // The path of `agent` at this node. O(depth).
  const PackedPath& path(AgentIndex agent) const;
  // All paths at this node; `paths` is resized to the number of agents. O(depth + total length).
  void paths(const Problem& problem, std::vector<Path>& paths) const;
  // The constraints on `agent` at this node, appended. O(depth).
  void constraints(AgentIndex agent, std::vector<Constraint>& constraints) const;

 private:
  mutable Ptr parent_;  // released by a dying descendant; see ~Node
  std::shared_ptr<const Tree> tree_;
  Cost bound_;
  Cost cost_;
  AgentConstraint added_;  // none at a root: agent -1
  PackedPath path_;
};

using NodePtr = Node::Ptr;

// The tasks that the stops of a sequence stand for.
std::vector<TaskIndex> tasks_in_order(const Agent& agent, const Sequence& sequence);

// The plan at a node whose paths are conflict-free.
Plan plan_at(const Problem& problem, const Node& node);

}  // namespace grove
