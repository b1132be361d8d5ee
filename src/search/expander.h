// SPDX-License-Identifier: MIT
// Expands constraint-tree nodes; all engines use this expander.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "model/counters.h"
#include "model/limits.h"
#include "search/brancher.h"
#include "search/node.h"
#include "search/node_view.h"
#include "search/path_planner.h"
#include "search/result_cache.h"
#include "search/search_options.h"
#include "search/wdg_heuristic.h"

namespace grove::detail {

// Result of an expansion. `stopped`: a limit was reached, or the costs to go of an agent would
// become too large. `unfinished`: bounding the node takes more effort than one call should spend.
// In both cases there is no result. Otherwise either `plan` is a cheapest plan of the node, or the
// children together hold every plan of the node that costs less than `cutoff`.
struct Expansion {
  bool stopped = false;
  bool unfinished = false;
  Cost cutoff = kInfiniteCost;    // the argument of expand(); not set if `stopped`
  std::optional<Plan> plan;       // conflict-free paths of the node's cost, if found
  std::vector<NodePtr> children;  // at most two, see Brancher::branch(); a single child may be the
                                  // same node with a higher bound
  std::optional<Branching> branching;  // if the node was split
};

// Counters of expansions: those that are reported, and those from which only the duration is
// estimated.
struct ExpansionCounts {
  Counters reported;
  std::int64_t mdd_nodes = 0;    // MddBuilder::nodes(), and nodes that FewestConflicts searched
  std::int64_t group_work = 0;   // effort of joint search, in the unit of model/effort.h
  std::int64_t subproblems = 0;  // look-ups of subproblems
  std::int64_t groups = 0;       // groups compared in full or looked up
  std::int64_t path_steps = 0;   // path steps searched for conflicts

  ExpansionCounts& operator+=(const ExpansionCounts& more);
  ExpansionCounts& operator-=(const ExpansionCounts& less);
};

// Expands nodes with the help of cached results on agents, pairs and groups. Every bound is proven,
// whatever the cache holds. The strength of a bound can depend on the cache, because each pair or
// group is examined only once, with the cutoff that applied then. One thread at a time; engines
// give each worker its own expander.
class Expander {
 public:
  // `problem`, `stops` and options.proof must outlive the expander; `stops` may be shared with
  // other objects of the same thread. `planner` plans agents whose sequence is free; nullptr:
  // Grove's own low level.
  Expander(const Problem& problem, AgentStopsCache& stops, const SearchOptions& options,
           std::shared_ptr<SharedCache> memory = std::make_shared<SharedCache>(),
           std::unique_ptr<AgentPlanner> planner = nullptr);

  // Expands `node`, looking only for plans that cost less than `cutoff` (the cost of the incumbent;
  // kInfiniteCost: all plans). A lower `bounding_effort` can make the node's bound weaker, but not
  // invalid. The expander keeps no reference to any node; otherwise the memory in use would depend
  // on which expander expanded which node last.
  Expansion expand(const NodePtr& node, Cost cutoff, const Limits& limits,
                   BoundingEffort bounding_effort = BoundingEffort::kFull);

  // Helps to bound `node` after its expansion by another worker has returned `unfinished`. Examines
  // the conflicting pairs that are left, starting at the fraction `share` in [0, 1) of the list of
  // pairs. The caller only has to publish the results. Returns whether it made low-level calls or
  // joint searches; if not, nothing that takes effort was left to do, or a limit was reached.
  bool help(const NodePtr& node, Cost cutoff, double share, const Limits& limits);

  ExpansionCounts counts() const;
  // Effort so far, in the unit of model/effort.h. work() counts the part by which the engine
  // balances tree search and primal search; whole_work() counts all of it.
  std::int64_t work() const {
    return planner_.work() + dependencies_.joint_groups().work() + work_on_nodes_;
  }
  double whole_work() const;

  // Only this expander sees its new results, until publish() merges them into the shared cache or
  // the caller merges the result of take_delta() elsewhere.
  void publish() { memory()->merge(take_delta()); }
  CacheDelta take_delta() { return memory_.take_delta(); }
  // Continues with this shared cache, possibly an empty one. If it is a different one, results that
  // were not taken are dropped.
  void use_shared_cache(std::shared_ptr<SharedCache> memory) {
    memory_.use_shared_cache(std::move(memory));
  }
  const std::shared_ptr<SharedCache>& memory() const { return memory_.common(); }
  // Per-agent data that is kept between nodes; see NodeView::swap_cache().
  struct AgentCaches {
    NodeView::AgentCache of_nodes;
    NodeView::AgentCache of_groups;
  };
  void swap_cache(AgentCaches& cache) {
    view_.swap_cache(cache.of_nodes);
    dependencies_.swap_cache(cache.of_groups);
  }

 private:
  struct Leaving;

  void enter(const NodePtr& node);
  Plan plan(const Node& node);
  void log_proof(const Branching& branching, const NodePtr& node, std::span<const NodePtr> children,
                 Cost cutoff);

  const Problem& problem_;
  const Techniques techniques_;
  ProofLog* const proof_;
  PathPlanner planner_;
  WorkerCache memory_;
  NodeView view_;
  Brancher brancher_;
  WdgHeuristic dependencies_;
  std::vector<AgentIndex> all_;
  std::vector<Split> splits_;
  std::int64_t work_on_nodes_ = 0;
};

}  // namespace grove::detail
