// SPDX-License-Identifier: MIT
// Bounds from pairs of agents that cannot both have their best paths.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planning/joint_mdd_search.h"
#include "search/brancher.h"
#include "search/covering.h"
#include "search/joint_groups.h"
#include "search/proof_log.h"
#include "search/result_cache.h"

namespace grove::detail {

// How much to find out about a node before it is split.
enum class BoundingEffort : std::uint8_t {
  kFull,
  kCachedOnly,  // for its children: nothing new; what is known counts
};

// The pairwise-dependency heuristic of CBS (WDG: Li et al., IJCAI 2019), with a memory that serves
// all nodes; also for larger groups that conflict though no pair of them must cost more. The essay
// is at the head of dependencies.cpp. Of one thread.
class WdgHeuristic {
 public:
  // All must outlive this.
  WdgHeuristic(const Problem& problem, const SearchOptions& options, PathPlanner& planner,
               WorkerCache& memory);

  enum class Outcome : std::uint8_t {
    kDone,
    kUnfinished,  // so much work was done that others should have their turn; asked again about the
                  // same node, it goes on
    kStopped,     // a limit struck
  };

  // Helps others that bound the same node with the same common memory: solves pairs, beginning at
  // this `share` in [0, 1) of them. False: nothing was left to do.
  bool help(const NodePtr& node, NodeView& view, Cost cutoff, double share, const Limits& limits);

  // A proven lower bound on every plan that obeys the constraints of `node`, which `view` has
  // entered with all agents; or `cutoff`, if none of them is cheaper. Sets `bound` only on kDone.
  Outcome find_bound(const NodePtr& node, NodeView& view, Cost cutoff,
                     BoundingEffort bounding_effort, const Limits& limits, Cost& bound);

  // Splits on the costs of two agents that conflict at the node that `view` has entered and are
  // known not to be able to keep both their costs: "the one comes to rest later | the other does".
  // Appended.
  void splits(NodeView& view, std::vector<Split>& splits);
  // Names the lemma by which such a split, at the node that `view` has entered, loses no plan.
  ProofKey why(NodeView& view, const Split& split);

  // Lets all nodes go.
  void leave();

  // So far: expansions in pairs; pairs of places compared in sets of optimal paths; and what their
  // view and brancher counted.
  std::int64_t expansions() const { return expansions_; }
  std::int64_t joint_pairs() const { return pair_dependency_.pairs(); }
  std::int64_t steps() const { return pair_view_.steps(); }
  // As NodeView::exchange, of the view of pairs and groups.
  void exchange(NodeView::Kept& kept) { pair_view_.exchange(kept); }
  // By joint search.
  const JointGroups& joint_groups() const { return joint_groups_; }
  std::int64_t optimal_nodes() const { return pair_brancher_.optimal_nodes(); }

 private:
  using Known = DependencyTable::Known;

  struct Open {
    Cost cost;
    NodePtr node;
  };

  void look_at(NodeView& view);
  bool may_cost(AgentIndex agent, Time cost) const;
  Outcome compute_weights(NodeView& view, Cost slack, const Limits& limits);
  Known known(AgentIndex a, AgentIndex b) const {
    return memory_.of_pair(situation_[a], situation_[b]);
  }
  Outcome solve_conflicting(NodeView& view, Cost slack, double share, const Limits& limits);
  std::optional<Dependence> compare(NodeView& view, AgentIndex a, AgentIndex b,
                                    const Limits& limits);
  const Mdd* optimal_paths(NodeView& view, AgentIndex agent, const Limits& limits);
  Outcome solve_groups(NodeView& view, Cost slack, const Limits& limits);
  std::vector<std::vector<AgentIndex>> groups_in_conflict(const NodeView& view) const;
  std::vector<SubproblemTable::Id> key(std::span<const AgentIndex> group) const;
  bool solve(const NodeView& view, std::span<const AgentIndex> group, Cost slack,
             std::int64_t most_expansions, const Limits& limits, Known& known);
  bool solve_by_splits(const NodePtr& node, std::span<const AgentIndex> group, Cost slack,
                       std::int64_t most_expansions, const Limits& limits, Known& known);
  void collect(std::vector<GroupExcess>& statements);
  void log_splits(const Open& from, Cost base, Cost closed);
  void log_lemma(const NodeView& view, std::span<const AgentIndex> group, Cost excess,
                 ProofKey root, std::span<const ProofSplit> splits);
  void log_bound(const NodeView& view, std::span<const GroupExcess> statements, Cost bound);
  std::int64_t work() const { return planner_.work() + joint_groups_.work(); }

  const Instance& instance_;
  const PathPlanner& planner_;
  const int agents_;
  const Techniques techniques_;
  const Tuning tuning_;
  ProofLog* const proof_;
  WorkerCache& memory_;
  NodeView pair_view_;  // of a pair or group
  Brancher pair_brancher_;
  JointMddSearch pair_dependency_;
  JointGroups joint_groups_;
  std::vector<SubproblemTable::Id> situation_;  // by AgentIndex, at the node
  std::vector<Open> open_;                      // a heap: least cost first
  std::vector<NodePtr> children_;
  std::vector<ProofSplit> written_;  // of the group under way, if there is a proof to be written
  std::vector<DependencyTable::Partner> partners_;
  std::int64_t expansions_ = 0;
  std::int64_t give_up_at_ = 0;  // of work()
};

}  // namespace grove::detail
