// SPDX-License-Identifier: MIT
// Excess of a pair or group of agents under the constraints of a node, by CBS on these agents only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "search/brancher.h"
#include "search/dependency_table.h"
#include "search/node_view.h"
#include "search/proof_log.h"

namespace grove::detail {

// CBS on a few agents. It starts at a node of the main search, uses the same splits, and considers
// only conflicts between these agents. The proof that its result is a bound is at the head of
// wdg_heuristic.cpp. One thread at a time.
class GroupCbs {
 public:
  using ExcessBound = DependencyTable::ExcessBound;

  // All arguments must outlive this object, except `options`, of which only options.proof must.
  GroupCbs(const Problem& problem, const SearchOptions& options, PathPlanner& planner,
           WorkerCache& memory)
      : proof_(options.proof),
        view_(problem, options, memory),
        brancher_(problem, options, planner, memory) {}

  // Raises `known`, the excess of the agents `group` over their paths at `node`, under the
  // constraints of that node. Ends when the excess is exact or above `slack`, or earlier after
  // `max_expansions` nodes or if the costs to go of an agent would become too large, with a valid
  // bound. Logs a lemma if the excess rises. Returns false if a limit of the run was reached.
  bool solve(const NodePtr& node, std::span<const AgentIndex> group, Cost slack,
             std::int64_t max_expansions, const Limits& limits, ExcessBound& known);

  // Drops all references to nodes.
  void leave();

  // Counters since construction: nodes expanded, steps of the view, and MDD nodes of the brancher.
  std::int64_t expansions() const { return expansions_; }
  std::int64_t steps() const { return view_.steps(); }
  std::int64_t mdd_nodes() const { return brancher_.mdd_nodes(); }
  // Like NodeView::swap_cache().
  void swap_cache(NodeView::AgentCache& cache) { view_.swap_cache(cache); }

 private:
  struct Open {
    Cost cost;
    NodePtr node;
  };

  Open take_least();
  void log_splits(const Open& from, Cost base, Cost closed);
  void log_lemma(const NodePtr& node, std::span<const AgentIndex> group, Cost excess);

  ProofLog* const proof_;
  NodeView view_;  // with the group in scope
  Brancher brancher_;
  std::vector<Open> open_;  // unsorted
  std::vector<NodePtr> children_;
  std::vector<ProofSplit> written_;  // splits of the current group, if a certificate is written
  std::int64_t expansions_ = 0;
};

}  // namespace grove::detail
