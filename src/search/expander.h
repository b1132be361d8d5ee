// SPDX-License-Identifier: MIT
// Expanding a node: the one place where constraint trees grow.
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

// What an expansion led to. If `stopped`, a limit struck, and if `unfinished`, there is more to
// find out about the node than should be done at one go: nothing else is set and the node is as it
// was. Otherwise the node's plans cheaper than the cutoff are exactly those of its children, or
// `plan` is the best of them.
struct Expansion {
  bool stopped = false;
  bool unfinished = false;
  Cost cutoff = kInfiniteCost;    // of the expansion: the cost of the incumbent then
  std::optional<Plan> plan;       // the node's paths, or others as cheap, are conflict-free
  std::vector<NodePtr> children;  // at most two; a child without a path is none. One: perhaps the
                                  // same node with a higher bound
  std::optional<Branching> branching;  // if the node was split
};

// What expanders have done so far.
struct ExpansionCounts {
  std::int64_t low_level_calls = 0;
  std::int64_t low_level_expanded = 0;  // labels
  std::int64_t pair_expansions = 0;
  std::int64_t optimal_nodes = 0;  // of sets of optimal paths, made or searched for conflicts
  std::int64_t joint_pairs = 0;    // of such nodes, compared
  std::int64_t group_states = 0;   // looked at by joint search of pairs and groups
  std::int64_t group_work = 0;     // of it, in the unit of work.h
  std::int64_t situations = 0;     // asked about
  std::int64_t groups = 0;         // asked about
  std::int64_t path_steps = 0;     // looked through for conflicts
  // What branching did: splits by the kind of their second demand (brancher.h), ways round for
  // free, prices asked for and answered from memory; and sets of optimal paths, likewise.
  std::array<std::int64_t, kConstraintKinds> splits{};
  std::int64_t bypasses = 0;
  std::int64_t prices_asked = 0;
  std::int64_t prices_known = 0;
  std::int64_t sets_asked = 0;
  std::int64_t sets_known = 0;

  ExpansionCounts& operator+=(const ExpansionCounts& more);
  ExpansionCounts& operator-=(const ExpansionCounts& less);
};

// Expands nodes with the workspace of one thread and the memory of what was found out about agents,
// pairs and groups before. What it says is proven whatever the memory holds; how much it says may
// depend on it, since a pair is looked into once, with the cutoff of that moment. Engines give each
// worker its own expander.
class Expander {
 public:
  // `problem` and `stops` must outlive the expander; `stops` may be shared with others of the same
  // thread. `planner` plans agents whose order is open; null: Grove's own low level.
  Expander(const Problem& problem, AgentStopsCache& stops, const SearchOptions& options,
           std::shared_ptr<SharedCache> memory = std::make_shared<SharedCache>(),
           std::unique_ptr<AgentPlanner> planner = nullptr);

  // Holds no node afterwards: how much memory nodes take would depend on who expanded which last.
  // `cutoff`: plans that cost so much or more are of no interest (the incumbent's cost;
  // kInfiniteCost: all are). `haste` makes the node's bound weaker, never wrong.
  Expansion expand(const NodePtr& node, Cost cutoff, const Limits& limits,
                   BoundingEffort bounding_effort = BoundingEffort::kFull);

  // Finds out some of what a worker needs that has come back with `node` unfinished, beginning at
  // this `share` in [0, 1) of it; to publish it is all. False: nothing was left to do.
  bool help(const NodePtr& node, Cost cutoff, double share, const Limits& limits);

  ExpansionCounts counts() const;
  // Work done so far: as it is weighed, and all of it; see work.h.
  std::int64_t work() const {
    return planner_.work() + dependencies_.joint_groups().work() + work_on_nodes_;
  }
  double whole_work() const;

  // What was found out is known to this expander only, until it is published, or handed over for
  // others to add to the memory.
  void publish() { memory()->merge(take_delta()); }
  CacheDelta take_delta() { return memory_.take_delta(); }
  // Goes on with another memory, perhaps an empty one.
  void turn_to(std::shared_ptr<SharedCache> memory) { memory_.turn_to(std::move(memory)); }
  const std::shared_ptr<SharedCache>& memory() const { return memory_.common(); }
  // What it keeps of agents from node to node; see NodeView::exchange.
  struct Kept {
    NodeView::Kept of_nodes;
    NodeView::Kept of_groups;
  };
  void exchange(Kept& kept) {
    view_.exchange(kept.of_nodes);
    dependencies_.exchange(kept.of_groups);
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
