// SPDX-License-Identifier: MIT
// View of a constraint-tree node that is restricted to some of its agents.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "conflicts/conflict.h"
#include "model/assert.h"
#include "search/node.h"
#include "search/result_cache.h"
#include "search/search_options.h"

namespace grove::detail {

// The paths, constraints and conflicts of a node, restricted to some agents, the *scope*. Only
// their paths and the conflicts among them exist in the view. With all agents in scope this is CBS;
// with a few agents it is CBS on these, under the node's constraints. One thread at a time.
class NodeView {
 public:
  // Per-agent data other from one node to the next, because most agents have the same constraints
  // at both.
  class AgentCache {
    friend class NodeView;

    struct CachedSubproblem {
      const AgentSequencing* order = nullptr;  // nullptr: unknown
      std::int64_t numbering = 0;              // WorkerCache::numbering()
      SubproblemTable::Id id = 0;
    };
    // By AgentIndex. Entries of agents in scope belong to the current node, others to an earlier
    // node.
    std::vector<std::vector<Constraint>> constraints;       // in canonical order
    std::vector<std::vector<Constraint>> node_constraints;  // in the order of the node
    std::vector<CachedSubproblem> subproblems;
  };

  // All arguments must outlive this. `memory` may be shared with others of the same thread.
  NodeView(const Problem& problem, const SearchOptions& options, WorkerCache& memory);

  // Loads a node. `scope` lists the agents in scope in ascending order.
  void enter(const NodePtr& node, std::span<const AgentIndex> scope);
  // Drops the reference to the node.
  void leave() { node_ = nullptr; }
  // Swaps the per-agent data between two nodes. So one view can serve several workers as if each
  // had its own view: the caller keeps the data of each and swaps them in.
  void swap_cache(AgentCache& other) { std::swap(other, agent_cache_); }

  const NodePtr& node() const { return node_; }
  std::span<const AgentIndex> scope() const { return scope_; }

  // Of an agent in scope: what the tree fixes about it, and its constraints in canonical order.
  const AgentSequencing& order(AgentIndex agent) const { return *node_->tree().orders[agent]; }
  std::span<const Constraint> constraints(AgentIndex agent) const {
    GROVE_ASSERT(is_in_scope(agent), "of others nothing is other up to date");
    return agent_cache_.constraints[agent];
  }
  SubproblemTable::Id subproblem(AgentIndex agent);
  // Its constraints and `more`, in canonical order. Valid until the next call.
  std::span<const Constraint> constraints_with(AgentIndex agent, const Constraint& more);

  // The paths in scope, by AgentIndex, as they are at the node or after reroute(), and all
  // conflicts among them in order of time.
  std::span<const Path> paths() const { return paths_; }
  const Path& path(AgentIndex agent) const { return paths_[agent]; }
  Time cost_of(AgentIndex agent) const { return static_cast<Time>(paths_[agent].size()) - 1; }
  std::span<const Conflict> conflicts() const { return conflicts_; }
  bool conflict_free() const { return conflicts_.empty(); }
  // The first conflict of these two agents. Returns nullptr if there is none.
  const Conflict* conflict_between(AgentIndex a, AgentIndex b) const;
  // Replaces `agents` by the agents in scope that must be re-planned under `constraint`: agents
  // whose path violates an implied constraint, and every agent with an implied constraint on its
  // sequence.
  void affected_agents(const AgentConstraint& constraint, std::vector<AgentIndex>& agents) const;

  // Replaces the paths of these agents by paths of the same cost that satisfy the node's
  // constraints.
  void reroute(std::span<const AgentIndex> agents, std::span<const Path> paths);
  // The node, or, after reroute(), a child of it with the same constraints and the current paths.
  NodePtr node_with_current_paths() const;

  // Path steps searched for conflicts so far.
  std::int64_t steps() const { return steps_; }

 private:
  bool is_in_scope(AgentIndex agent) const { return std::ranges::binary_search(scope_, agent); }
  void update_constraints();
  void find_conflicts();

  const Problem& problem_;
  const bool audit_;
  WorkerCache& memory_;
  ConflictFinder finder_;

  NodePtr node_;
  std::vector<AgentIndex> scope_;
  std::vector<Path> paths_;  // by AgentIndex
  AgentCache agent_cache_;
  std::vector<std::vector<Constraint>> constraints_;
  std::vector<Conflict> conflicts_;
  std::vector<AgentIndex> rerouted_;
  std::vector<Constraint> extended_;
  std::int64_t steps_ = 0;
};

}  // namespace grove::detail
