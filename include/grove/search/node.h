// SPDX-License-Identifier: MIT
// Constraint-tree nodes and the trees they belong to.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "grove/conflicts/conflict.h"
#include "grove/model/omega.h"
#include "grove/planning/goal_sequence.h"
#include "grove/search/node_pool.h"
#include "grove/search/packed_path.h"
#include "grove/search/problem.h"
#include "grove/sequencing/rtsp.h"

namespace grove {

// What a tree fixes about one agent's order of visits, and the agent's best path when nobody else
// is there. Immutable; shared by all trees that fix the same.
struct AgentOrder {
  SequenceClass sequences;            // the paper's forest: a complete prefix
  std::optional<GoalSequence> goals;  // of a complete prefix; else the low level chooses the order
  PackedPath path;                    // shortest for `sequences`, no constraints
};

// One tree of the forest: a class of joint task sequences. Immutable; outlives its nodes.
struct Tree {
  NodePool* pool = nullptr;                               // where its nodes live
  std::vector<std::shared_ptr<const AgentOrder>> orders;  // by AgentIndex
};

class Node;

// Shared ownership of a node. Copies may be made and dropped by different threads.
class NodePtr {
 public:
  NodePtr() = default;
  NodePtr(std::nullptr_t) {}
  explicit NodePtr(const Node* node);  // shares
  NodePtr(const NodePtr& other) : NodePtr(other.node_) {}
  NodePtr(NodePtr&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  NodePtr& operator=(NodePtr other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~NodePtr();

  const Node& operator*() const { return *node_; }
  const Node* operator->() const { return node_; }
  const Node* get() const { return node_; }
  explicit operator bool() const { return node_ != nullptr; }
  friend bool operator==(const NodePtr& a, const NodePtr& b) { return a.node_ == b.node_; }

  // Forgets the node without giving it up: its memory is freed with its pool.
  void abandon() { node_ = nullptr; }

 private:
  const Node* node_ = nullptr;
};

// A node of a constraint tree (CBS; Sharon et al. 2015): its parent's constraints and one more, and
// the path that this one changed, packed behind the object. Immutable once made, so threads may
// share it. Lives in its tree's pool, about 140 bytes at 150 steps a path.
class Node {
 public:
  // The root of `tree`, no constraints.
  static NodePtr root(const Tree& tree);
  // The child in which `added.agent` obeys one constraint more and takes `path`, `cost` being then
  // the sum of all agents' costs. Its bound is at least its parent's.
  static NodePtr child(const NodePtr& parent, const Grid& grid, const AgentConstraint& added,
                       const Path& path, Cost cost);

  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // Proven: every plan of the tree that obeys this node's constraints costs at least this.
  Cost bound() const { return bound_; }
  // Sum of the costs of the paths at this node.
  Cost cost() const { return cost_; }
  const Tree& tree() const { return *tree_; }
  bool is_root() const { return !parent_; }

  // All paths at this node; `paths` is resized to the number of agents. O(depth + total length).
  void paths(const Problem& problem, std::vector<Path>& paths) const;
  // The constraints on `agent` at this node, appended. O(depth).
  void constraints(AgentIndex agent, std::vector<Constraint>& constraints) const;

 private:
  friend class NodePtr;
  Node(NodePtr parent, const Tree& tree, Cost bound, Cost cost, const AgentConstraint& added,
       std::uint32_t steps)
      : steps_(steps),
        parent_(std::move(parent)),
        tree_(&tree),
        bound_(bound),
        cost_(cost),
        added_(added) {}

  static std::size_t bytes(std::uint32_t steps) {
    return sizeof(Node) + packed_words(steps) * sizeof(std::uint64_t);
  }
  const std::uint64_t* words() const { return reinterpret_cast<const std::uint64_t*>(this + 1); }
  PackedSteps path() const { return {steps_, words()}; }
  static void release(const Node* node);

  mutable std::atomic<std::uint32_t> references_{0};
  std::uint32_t steps_;
  mutable NodePtr parent_;  // null at a root
  const Tree* tree_;
  Cost bound_;
  Cost cost_;
  AgentConstraint added_;  // at a root: agent -1
};

inline NodePtr::NodePtr(const Node* node) : node_(node) {
  if (node_) node_->references_.fetch_add(1, std::memory_order_relaxed);
}

inline NodePtr::~NodePtr() {
  if (node_) Node::release(node_);
}

// The tasks that the stops of a sequence stand for.
std::vector<TaskIndex> tasks_in_order(const Agent& agent, const Sequence& sequence);

}  // namespace grove
