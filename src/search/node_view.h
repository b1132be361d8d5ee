// SPDX-License-Identifier: MIT
// A constraint-tree node as some of its agents see it.
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

// Looks at a node through the eyes of some of its agents, the *scope*: only their paths are there,
// and only conflicts among them. With all agents in scope that is CBS; with a few it is CBS on what
// the node demands of them. Workspace of one thread.
class NodeView {
 public:
  // What it keeps of agents from one node to the next, where most are asked for the same.
  class Kept {
    friend class NodeView;

    struct KnownSituation {
      const AgentSequencing* order = nullptr;  // null: not known
      std::int64_t numbering = 0;              // of the memory
      SubproblemTable::Id id = 0;
    };
    // By AgentIndex. Those of agents in scope are of this node, those of others of an earlier one.
    std::vector<std::vector<Constraint>> constraints;  // canonical
    std::vector<std::vector<Constraint>> demands;      // as the node lists them
    std::vector<KnownSituation> situations;
  };

  // All must outlive this; `memory` may be shared with others of the same thread.
  NodeView(const Problem& problem, const SearchOptions& options, WorkerCache& memory);

  // Turns to a node and to the agents in scope, which are in ascending order.
  void enter(const NodePtr& node, std::span<const AgentIndex> scope);
  // Lets the node go.
  void leave() { node_ = nullptr; }
  // Between two nodes: one view can serve several workers as if each had its own, if it is given
  // what it kept for each in turn.
  void exchange(Kept& kept) { std::swap(kept, kept_); }

  const NodePtr& node() const { return node_; }
  std::span<const AgentIndex> scope() const { return scope_; }

  // Of an agent in scope: its order of visits, and what the node demands of it, in canonical order.
  const AgentSequencing& order(AgentIndex agent) const { return *node_->tree().orders[agent]; }
  std::span<const Constraint> constraints(AgentIndex agent) const {
    GROVE_ASSERT(is_in_scope(agent), "of others nothing is kept up to date");
    return kept_.constraints[agent];
  }
  SubproblemTable::Id situation(AgentIndex agent);
  // The same with one constraint more, in canonical order; until the next call.
  std::span<const Constraint> constraints_with(AgentIndex agent, const Constraint& more);

  // The paths in scope, by AgentIndex, as they are at the node or after reroute(), and every
  // conflict among them, in order of time.
  std::span<const Path> paths() const { return paths_; }
  const Path& path(AgentIndex agent) const { return paths_[agent]; }
  Time cost_of(AgentIndex agent) const { return static_cast<Time>(paths_[agent].size()) - 1; }
  std::span<const Conflict> conflicts() const { return conflicts_; }
  bool conflict_free() const { return conflicts_.empty(); }
  // The first of these two; null: there is none.
  const Conflict* conflict_between(AgentIndex a, AgentIndex b) const;
  // Who in scope must go another way if `demand` is made: whose path does not obey what it asks,
  // or, if that is about the sequence, who is asked. Replaces `agents`.
  void affected_agents(const AgentConstraint& demand, std::vector<AgentIndex>& agents) const;

  // Sends agents ways that cost as much and obey the node's constraints.
  void reroute(std::span<const AgentIndex> agents, std::span<const Path> paths);
  // The node, or below it one that demands the same and has the paths that are here now.
  NodePtr node_with_current_paths() const;

  // Steps of paths looked through for conflicts, so far.
  std::int64_t steps() const { return steps_; }

 private:
  bool is_in_scope(AgentIndex agent) const { return std::ranges::binary_search(scope_, agent); }
  void look_at_constraints();
  void find_conflicts();

  const Problem& problem_;
  const bool audit_;
  WorkerCache& memory_;
  ConflictFinder finder_;

  NodePtr node_;
  std::vector<AgentIndex> scope_;
  std::vector<Path> paths_;  // by AgentIndex
  Kept kept_;
  std::vector<std::vector<Constraint>> demands_;
  std::vector<Conflict> conflicts_;
  std::vector<AgentIndex> rerouted_;
  std::vector<Constraint> extended_;
  std::int64_t steps_ = 0;
};

}  // namespace grove::detail
