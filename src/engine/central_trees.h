// SPDX-License-Identifier: MIT
// Instantiates the trees of a run by Algorithm 4 of the paper.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/central_bounds.h"
#include "engine/live_nodes.h"
#include "engine/run_events.h"
#include "engine/solve.h"
#include "engine/tree_supply.h"
#include "search/forest.h"
#include "search/tree_record.h"

namespace grove::detail {

// Instantiates the next tree of a forest when GlobalBounds requires it, and pushes its root. When
// no node is live but some were evicted, it can push the roots again; see restart() in the .cpp.
class CentralTrees : public TreeSupply {
 public:
  // All arguments must outlive this object.
  CentralTrees(const SolveOptions& options, Forest& forest, LiveNodes& nodes,
               CentralBounds& shared_bounds, RunEvents& run_events);

  // Must be called before the other functions, on one thread. resume_with() adds one tree of an
  // earlier run, after the forest has made the same tree and before the tree's nodes are pushed.
  // begin(), called last, instantiates the first tree unless resume_with() added one or the run is
  // over.
  void resume_with(const NodePtr& root);
  void begin();

  // Number of trees instantiated so far. Their roots have been pushed or pruned, except the roots
  // passed to resume_with().
  std::int64_t count() const { return count_; }
  // Returns the records of the first `count` trees.
  std::vector<TreeRecord> records(std::int64_t count) const;
  // Adds the counts of this object to the statistics of the solution.
  void add_counts(Counters& counters) const;

  void instantiate_due_tree() override;
  void refill_nodes() override;
  bool claim_preparation() override;
  void prepare_tree() override;

 private:
  bool is_due() const;
  void instantiate(const NodePtr& root);
  void log_proof(const Node& root) const;
  void grow();
  bool restart();

  const SolveOptions& options_;
  Forest& forest_;  // guarded by growing_
  LiveNodes& nodes_;
  CentralBounds& shared_bounds_;
  RunEvents& run_events_;

  mutable std::mutex growing_;  // guards the forest and the non-atomic members below
  std::vector<NodePtr> roots_;  // by tree number
  NodePtr prepared_;            // root of the next tree if prepared, else nullptr
  Cost restarted_at_ = -1;      // evicted_bound() at the last restart; -1: none
  std::int64_t restarts_ = 0;

  std::atomic<Cost> last_cost_;  // root cost of the tree instantiated last
  std::atomic<std::int64_t> count_{0};
  std::atomic<bool> preparing_{false};
  std::atomic<std::int64_t> prepared_count_{0};
};

}  // namespace grove::detail
