// SPDX-License-Identifier: MIT
// WDG heuristic of CBS: lower bounds from pairs and groups of agents that cost more together than
// individually.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planning/joint_mdd_search.h"
#include "search/covering.h"
#include "search/group_cbs.h"
#include "search/joint_groups.h"
#include "search/proof_log.h"
#include "search/result_cache.h"

namespace grove::detail {

// How much effort may be spent on the bound of a node before the node is split.
enum class BoundingEffort : std::uint8_t {
  kFull,
  kCachedOnly,  // only cached results, no new search, so that children exist sooner
};

// Weighted pairwise-dependency heuristic of CBS (WDG: Li et al., IJCAI 2019), with a cache that
// serves all nodes. It also bounds groups of three to six agents that are connected by conflicts of
// pairs without a known positive excess. The proof is at the head of wdg_heuristic.cpp. One thread
// at a time.
class WdgHeuristic {
 public:
  // `problem`, `planner`, `memory` and options.proof must outlive this object.
  WdgHeuristic(const Problem& problem, const SearchOptions& options, PathPlanner& planner,
               WorkerCache& memory);

  enum class Outcome : std::uint8_t {
    kDone,
    kUnfinished,  // Tuning::bound_work was reached, so the worker can do something else; the next
                  // call for the same node continues
    kStopped,     // a limit was reached
  };

  // Helps other workers that bound the same node with the same shared cache: bounds conflicting
  // pairs, starting at the fraction `share` in [0, 1) of the list of pairs. Returns whether it made
  // low-level calls or joint searches; if not, nothing that takes effort was left to do, or a limit
  // was reached.
  bool help(const NodePtr& node, NodeView& view, Cost cutoff, double share, const Limits& limits);

  // Sets `bound` to a proven lower bound on every plan that satisfies the constraints of `node`, or
  // to `cutoff` if no such plan costs less than `cutoff`. `view` must have entered `node` with all
  // agents. `bound` is valid only if the result is kDone.
  Outcome find_bound(const NodePtr& node, NodeView& view, Cost cutoff,
                     BoundingEffort bounding_effort, const Limits& limits, Cost& bound);

  // Appends the splits on costs, "a comes to rest later, or b does". It appends one for each pair
  // of agents that conflict at the node that `view` has entered, finish when they arrive, and are
  // known to be unable to both keep their costs. A split can occur repeatedly.
  void splits(NodeView& view, std::vector<Split>& splits);
  // Key of the lemma that proves that the split on costs `split` loses no plan. `view` has entered
  // the node that is split.
  ProofKey lemma_key(NodeView& view, const Split& split);

  // Drops all references to nodes.
  void leave() { group_cbs_.leave(); }

  // Counters since construction. expansions(): nodes expanded for pairs and groups.
  // joint_mdd_nodes(): pairs of MDD nodes compared in joint MDDs. steps() and mdd_nodes(): the
  // counters of the view and of the brancher for pairs and groups.
  std::int64_t expansions() const { return group_cbs_.expansions(); }
  std::int64_t joint_mdd_nodes() const { return joint_mdd_search_.pairs(); }
  std::int64_t steps() const { return group_cbs_.steps(); }
  // Like NodeView::swap_cache(), for the view for pairs and groups.
  void swap_cache(NodeView::AgentCache& cache) { group_cbs_.swap_cache(cache); }
  // The joint search for pairs and groups.
  const JointGroups& joint_groups() const { return joint_groups_; }
  std::int64_t mdd_nodes() const { return group_cbs_.mdd_nodes(); }

 private:
  using ExcessBound = DependencyTable::ExcessBound;

  void load_subproblems(NodeView& view);
  bool may_cost(AgentIndex agent, Time cost) const;
  Outcome compute_weights(NodeView& view, Cost slack, const Limits& limits);
  ExcessBound known(AgentIndex a, AgentIndex b) const {
    return memory_.of_pair(subproblem_[a], subproblem_[b]);
  }
  Outcome solve_conflicting_pairs(NodeView& view, Cost slack, double share, const Limits& limits);
  std::optional<Dependence> compare(NodeView& view, AgentIndex a, AgentIndex b,
                                    const Limits& limits);
  const Mdd* mdd(NodeView& view, AgentIndex agent, const Limits& limits);
  Outcome solve_groups(NodeView& view, Cost slack, const Limits& limits);
  std::vector<std::vector<AgentIndex>> groups_in_conflict(const NodeView& view) const;
  std::vector<SubproblemTable::Id> key(std::span<const AgentIndex> group) const;
  bool solve(const NodeView& view, std::span<const AgentIndex> group, Cost slack,
             std::int64_t max_expansions, const Limits& limits, ExcessBound& known);
  void log_lemma(const NodeView& view, std::span<const AgentIndex> group, Cost excess);
  void log_bound(const NodeView& view, std::span<const GroupExcess> statements, Cost bound);
  std::int64_t work() const { return planner_.work() + joint_groups_.work(); }

  const Instance& instance_;
  const PathPlanner& planner_;
  const AgentIndex agents_;
  const Techniques techniques_;
  const Tuning tuning_;
  ProofLog* const proof_;
  WorkerCache& memory_;
  GroupCbs group_cbs_;
  JointMddSearch joint_mdd_search_;
  JointGroups joint_groups_;
  std::vector<SubproblemTable::Id> subproblem_;  // by AgentIndex, at the node
  std::vector<DependencyTable::Partner> partners_;
  std::int64_t abort_at_ = 0;  // value of work() at which to abort
};

}  // namespace grove::detail
