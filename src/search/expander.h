// SPDX-License-Identifier: MIT
// Expansion of a node: the only place where constraint trees grow.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "model/limits.h"
#include "search/brancher.h"
#include "search/node.h"
#include "search/node_view.h"
#include "search/path_planner.h"
#include "search/result_cache.h"
#include "search/search_options.h"
#include "search/wdg_heuristic.h"

namespace grove::detail {

// Result of an expansion. `stopped`: a limit was reached. `unfinished`: bounding the node takes
// more work than one call should do. In both cases nothing else is set and the node is unchanged.
// Otherwise the node's plans cheaper than the cutoff are exactly those of its children, or `plan`
// is the best of them.
struct Expansion {
  bool stopped = false;
  bool unfinished = false;
  Cost cutoff = kInfiniteCost;    // cost of the incumbent at the time of the call
  std::optional<Plan> plan;       // the node's paths, or others of equal cost, if conflict-free
  std::vector<NodePtr> children;  // at most two; a child without a path is omitted. A single child
                                  // may be the same node with a higher bound
  std::optional<Branching> branching;  // if the node was split
};

// Counters of expansions.
struct ExpansionCounts {
  std::int64_t low_level_calls = 0;
  std::int64_t low_level_expanded = 0;  // labels
  std::int64_t pair_expansions = 0;
  std::int64_t optimal_nodes = 0;    // MDD nodes built or searched for conflicts
  std::int64_t joint_mdd_nodes = 0;  // pairs of MDD nodes compared (joint MDDs)
  std::int64_t group_states = 0;     // states examined by joint search of pairs and groups
  std::int64_t group_work = 0;       // work of joint search, in the unit of work.h
  std::int64_t subproblems = 0;      // look-ups of subproblems
  std::int64_t groups = 0;           // groups looked up
  std::int64_t path_steps = 0;       // path steps searched for conflicts
  // Branching: splits by the kind of their second constraint (brancher.h), bypasses, strong
  // branching costs requested and answered from the cache. Then MDDs requested and answered from
  // the cache.
  std::array<std::int64_t, kConstraintKinds> splits{};
  std::int64_t bypasses = 0;
  std::int64_t branching_cost_queries = 0;
  std::int64_t branching_cost_hits = 0;
  std::int64_t mdd_queries = 0;
  std::int64_t mdd_hits = 0;

  ExpansionCounts& operator+=(const ExpansionCounts& more);
  ExpansionCounts& operator-=(const ExpansionCounts& less);
};

// Expands nodes, with cached results on agents, pairs and groups. Every bound is proven whatever
// the cache holds. The strength of a bound may depend on the cache, because a pair is examined
// once, with the cutoff of that moment. One thread at a time; engines give each worker its own
// expander.
class Expander {
 public:
  // `problem` and `stops` must outlive the expander; `stops` may be shared with other objects of
  // the same thread. `planner` plans agents whose order of visits is free; nullptr: Grove's low
  // level.
  Expander(const Problem& problem, AgentStopsCache& stops, const SearchOptions& options,
           std::shared_ptr<SharedCache> memory = std::make_shared<SharedCache>(),
           std::unique_ptr<AgentPlanner> planner = nullptr);

  // Expands `node` for plans that cost less than `cutoff` (the cost of the incumbent;
  // kInfiniteCost: all plans). A lower `bounding_effort` makes the node's bound weaker, but not
  // invalid. The expander holds no node afterwards; otherwise the memory used by nodes would depend
  // on which expander expanded which node last.
  Expansion expand(const NodePtr& node, Cost cutoff, const Limits& limits,
                   BoundingEffort bounding_effort = BoundingEffort::kFull);

  // Helps to bound `node`, whose expansion by another worker returned `unfinished`: does part of
  // the work that is left, beginning at fraction `share` in [0, 1) of it. The caller only has to
  // publish the results. Returns false if nothing was left to do.
  bool help(const NodePtr& node, Cost cutoff, double share, const Limits& limits);

  ExpansionCounts counts() const;
  // Work done so far, see work.h: work() is the part by which tree and primal search are weighed
  // against each other, whole_work() is all of it.
  std::int64_t work() const {
    return planner_.work() + dependencies_.joint_groups().work() + work_on_nodes_;
  }
  double whole_work() const;

  // New results are visible to this expander only, until publish() merges them into the shared
  // cache or take_delta() hands them over for merging elsewhere.
  void publish() { memory()->merge(take_delta()); }
  CacheDelta take_delta() { return memory_.take_delta(); }
  // Continues with another shared cache, possibly an empty one.
  void use_shared_cache(std::shared_ptr<SharedCache> memory) {
    memory_.use_shared_cache(std::move(memory));
  }
  const std::shared_ptr<SharedCache>& memory() const { return memory_.common(); }
  // Per-agent data cache between nodes; see NodeView::swap_cache.
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
