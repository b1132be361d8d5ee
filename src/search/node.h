// SPDX-License-Identifier: MIT
// Constraint-tree nodes and the trees they belong to.
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "conflicts/conflict.h"
#include "model/assert.h"
#include "model/omega.h"
#include "planning/goal_sequence.h"
#include "planning/problem.h"
#include "search/node_pool.h"
#include "search/packed_path.h"
#include "sequencing/rtsp.h"

namespace grove::detail {

// What a tree fixes about one agent: its sequence class, and its shortest path without other
// agents. Trees that fix the same for an agent share one object. Immutable: any thread may read it.
struct AgentSequencing {
  SequenceClass sequences;            // in the paper's forest: a complete prefix
  std::optional<GoalSequence> goals;  // of a complete prefix; nullopt: free order
  PackedPath path;                    // a shortest one for `sequences`, without constraints
  // The tasks that the agent visits, in this order, if it may choose tasks. nullopt: all its tasks,
  // in an order of `sequences`.
  std::optional<std::vector<TaskIndex>> visits = std::nullopt;
};

// One tree of the forest, which holds the plans of one class of joint task sequences. Immutable:
// any thread may read it. Must outlive its nodes.
struct Tree {
  const World* world = nullptr;  // world of the agents
  NodePool* pool = nullptr;      // owns the memory of its nodes
  std::uint32_t number = 0;      // from 0, in the order of instantiation
  std::vector<std::shared_ptr<const AgentSequencing>> orders;  // by AgentIndex
};

class Node;

// Shared ownership of a node. Different threads may copy and destroy different NodePtr objects of
// one node concurrently.
class NodePtr {
 public:
  NodePtr() = default;
  NodePtr(std::nullptr_t) {}
  explicit NodePtr(const Node* node);  // shares ownership
  NodePtr(const NodePtr& other) : NodePtr(other.node_) {}
  NodePtr(NodePtr&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  NodePtr& operator=(NodePtr other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~NodePtr();

  const Node& operator*() const { return *operator->(); }
  const Node* operator->() const {
    GROVE_ASSERT(node_, "the pointer is not null");
    return node_;
  }
  const Node* get() const { return node_; }
  explicit operator bool() const { return node_ != nullptr; }
  friend bool operator==(const NodePtr& a, const NodePtr& b) { return a.node_ == b.node_; }

  // Drops the pointer without releasing the node, whose memory is freed with its pool.
  void abandon() { node_ = nullptr; }

 private:
  const Node* node_ = nullptr;
};

// An agent and its new path.
struct NewPath {
  AgentIndex agent = -1;
  const Path* path = nullptr;
};

// What a child adds to its parent.
struct NodeDelta {
  AgentConstraint added;           // agent -1: no constraint
  std::span<const NewPath> paths;  // of the agents whose path changes
  Cost cost = 0;                   // sum of the costs of all paths at the child
  Cost bound = 0;                  // lower bound on all plans that satisfy the child's constraints
  std::uint32_t conflicts = 0;     // among its paths, approximate: estimates the distance to a plan
  bool bounded = false;            // the WDG heuristic has raised its bound and is not run again
};

// A node of a constraint tree (CBS; Sharon et al. 2015). It inherits its parent's constraints and
// paths, and stores at most one additional constraint and the paths that changed. The paths are
// packed behind the object. A kRestBy constraint on one agent also bars all other agents from the
// cell from its `end` on. A node is allocated in its tree's pool; it takes about 150 bytes if paths
// have 150 steps. Immutable: any thread may read it.
class Node {
 public:
  // The root of `tree`, without constraints.
  static NodePtr root(const Tree& tree);
  // A child of `parent`. Its bound is the maximum of the parent's bound, change.cost and
  // change.bound.
  static NodePtr child(const NodePtr& parent, const NodeDelta& change);

  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // Proven lower bound on every plan of the tree that satisfies this node's constraints.
  Cost bound() const { return bound_; }
  // Sum of the costs of the paths at this node.
  Cost cost() const { return cost_; }
  // As in NodeDelta.
  std::uint32_t conflicts() const { return conflicts_; }
  bool is_bounded() const { return bounded_; }
  const Tree& tree() const { return *tree_; }
  bool is_root() const { return !parent_; }
  // The parent; nullptr at the root.
  const Node* parent() const { return parent_.get(); }
  // The constraint that this node adds to those of its parent; agent -1: none.
  const AgentConstraint& added() const { return added_; }
  // Calls visit(agent, packed steps) for each path that this node stores. The packed steps are
  // valid as long as the node exists.
  template <class Visit>
  void for_each_path(Visit visit) const {
    const auto* word = reinterpret_cast<const std::uint64_t*>(this + 1);
    for (std::uint32_t i = 0; i < path_count_; ++i) {
      const auto head = std::bit_cast<PathHead>(*word++);
      visit(head.agent, PackedSteps{head.steps, word});
      word += packed_words(*tree_->world, head.steps);
    }
  }

  // Unpacks the paths at this node of all agents or of `agents`; the other entries are empty.
  // Resizes `paths` to the number of agents. O(depth + total length).
  void paths(const Problem& problem, std::vector<Path>& paths) const;
  void paths(const Problem& problem, std::span<const AgentIndex> agents,
             std::vector<Path>& paths) const;
  // Appends the constraints on `agent` at this node. O(depth).
  void constraints(AgentIndex agent, std::vector<Constraint>& constraints) const;
  // Sets each constraints[agent] to the constraints on that agent at this node. Resizes
  // `constraints` to the number of agents.
  void constraints(std::vector<std::vector<Constraint>>& constraints) const;

 private:
  friend class NodePtr;
  // Header in front of each packed path.
  struct PathHead {
    AgentIndex agent;
    std::uint32_t steps;
  };
  static_assert(sizeof(PathHead) == sizeof(std::uint64_t));

  Node(NodePtr parent, const Tree& tree, const NodeDelta& change)
      : path_count_(static_cast<std::uint32_t>(change.paths.size())),
        parent_(std::move(parent)),
        tree_(&tree),
        bound_(change.bound),
        cost_(change.cost),
        added_(change.added),
        conflicts_(change.conflicts),
        bounded_(change.bounded) {}

  static std::size_t bytes(const World& world, std::span<const NewPath> paths);
  std::size_t bytes() const;
  static void release(const Node* node);

  mutable std::atomic<std::uint32_t> references_{0};
  std::uint32_t path_count_;
  mutable NodePtr parent_;  // nullptr at the root
  const Tree* tree_;
  Cost bound_;
  Cost cost_;
  AgentConstraint added_;  // agent -1: none
  std::uint32_t conflicts_;
  bool bounded_;
};

inline NodePtr::NodePtr(const Node* node) : node_(node) {
  if (node_) node_->references_.fetch_add(1, std::memory_order_relaxed);
}

inline NodePtr::~NodePtr() {
  if (node_) Node::release(node_);
}

// The goals of `agent` if it visits all its stops in the order `sequence`; see GoalSequence.
GoalSequence goals_in_order(const Problem& problem, AgentIndex agent, const Sequence& sequence);

}  // namespace grove::detail
