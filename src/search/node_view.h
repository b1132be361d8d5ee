// SPDX-License-Identifier: MIT
// View of a constraint-tree node, restricted to some of its agents.
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

// The paths, constraints and conflicts of a node, restricted to some agents, the *scope*. Paths of
// other agents, and conflicts with these agents, are not in the view. With all agents in scope,
// branching on the view is CBS; with a few agents in scope, it is CBS on these agents under the
// node's constraints. One thread at a time.
class NodeView {
 public:
  // Per-agent data that is kept from one node to the next, because most agents have the same
  // constraints at both nodes.
  class AgentCache {
    friend class NodeView;

    struct CachedSubproblem {
      const AgentSequencing* order = nullptr;  // nullptr: unknown
      std::int64_t numbering = 0;              // WorkerCache::numbering()
      SubproblemTable::Id id = 0;
    };
    // By AgentIndex. Entries of agents in scope belong to the current node, entries of other agents
    // to an earlier node.
    std::vector<std::vector<Constraint>> constraints;       // in canonical order
    std::vector<std::vector<Constraint>> node_constraints;  // in the order of the node
    std::vector<CachedSubproblem> subproblems;
  };

  // `problem` and `memory` must outlive this object. `memory` may be shared with other objects of
  // the same thread.
  NodeView(const Problem& problem, const SearchOptions& options, WorkerCache& memory);

  // Loads a node. `scope` lists the agents in scope in ascending order.
  void enter(const NodePtr& node, std::span<const AgentIndex> scope);
  // Drops the reference to the node.
  void leave() { node_ = nullptr; }
  // Swaps the kept data with `other`. Call it between two nodes. One view can thus serve several
  // workers as if each had its own view: the caller stores the data of each worker and swaps it in.
  void swap_cache(AgentCache& other) { std::swap(other, agent_cache_); }

  const NodePtr& node() const { return node_; }
  std::span<const AgentIndex> scope() const { return scope_; }

  // order(): what the tree fixes about `agent`. constraints(): the constraints on `agent` in
  // canonical order. subproblem(): the number of its subproblem. The agent must be in scope.
  const AgentSequencing& order(AgentIndex agent) const { return *node_->tree().orders[agent]; }
  std::span<const Constraint> constraints(AgentIndex agent) const {
    GROVE_ASSERT(is_in_scope(agent), "only agents in scope are up to date");
    return agent_cache_.constraints[agent];
  }
  SubproblemTable::Id subproblem(AgentIndex agent);
  // The constraints on `agent`, which must be in scope, and `more`, in canonical order. Valid until
  // the next call of constraints_with().
  std::span<const Constraint> constraints_with(AgentIndex agent, const Constraint& more);

  // paths(): by AgentIndex, the paths of the agents in scope, at the node or after reroute(); other
  // entries are empty. cost_of(): in steps. conflicts(): all conflicts among these paths, in order
  // of time.
  std::span<const Path> paths() const { return paths_; }
  const Path& path(AgentIndex agent) const { return paths_[agent]; }
  Time cost_of(AgentIndex agent) const { return static_cast<Time>(paths_[agent].size()) - 1; }
  std::span<const Conflict> conflicts() const { return conflicts_; }
  bool conflict_free() const { return conflicts_.empty(); }
  // The first conflict of agents `a` and `b`. Returns nullptr if they have none.
  const Conflict* conflict_between(AgentIndex a, AgentIndex b) const;
  // Replaces `agents` by the agents in scope that must be re-planned under `constraint`: those
  // whose path violates the constraint that it implies for them.
  void affected_agents(const AgentConstraint& constraint, std::vector<AgentIndex>& agents) const;

  // Replaces the path of each agent in `agents` by the one at the same position in `paths`, which
  // must have the same cost and satisfy the node's constraints.
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
