// SPDX-License-Identifier: MIT
// The trees of a run, as Algorithm 4 of the paper brings them.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/central_bounds.h"
#include "engine/live_nodes.h"
#include "engine/run_events.h"
#include "engine/solve.h"
#include "engine/tree_source.h"
#include "search/forest.h"
#include "search/tree_record.h"

namespace grove::detail {

// Instantiates trees of a forest when the ledger's gate finds that necessary, and pushes their
// roots; once more when no node is left but some were given up.
class CentralTrees : public TreeSource {
 public:
  // All must outlive this.
  CentralTrees(const SolveOptions& options, Forest& forest, LiveNodes& nodes, CentralBounds& ledger,
               RunEvents& announcements);

  // Before all else, from one thread: trees that an earlier run instantiated, one by one, each
  // after the forest has made the same and before its nodes are pushed; then the first tree, if
  // there are none.
  void resume_with(const NodePtr& root);
  void begin();

  // How many are instantiated, and their roots pushed.
  std::int64_t count() const { return count_; }
  // The first so many.
  std::vector<TreeRecord> records(std::int64_t count) const;
  // Adds what was counted here to the answer's statistics.
  void add_counts(Stats& stats) const;

  void instantiate_due_tree() override;
  void refill_nodes() override;
  bool claim_preparation() override;
  void prepare_tree() override;

 private:
  bool is_due() const;
  void instantiate(const NodePtr& root);
  void log_proof(const Node& root) const;
  void grow();
  bool begin_anew();

  const SolveOptions& options_;
  Forest& forest_;  // under growing_
  LiveNodes& nodes_;
  CentralBounds& ledger_;
  RunEvents& announcements_;

  mutable std::mutex growing_;  // guards the forest and what follows
  std::vector<NodePtr> roots_;  // by the number of the tree
  NodePtr prepared_;            // of the next tree, if it has been prepared
  Cost begun_anew_at_ = -1;     // the bound that the last run through the trees proved
  std::int64_t restarts_ = 0;

  std::atomic<Cost> last_cost_;  // of the tree instantiated last
  std::atomic<std::int64_t> count_{0};
  std::atomic<bool> preparing_{false};
  std::atomic<std::int64_t> prepared_count_{0};
};

}  // namespace grove::detail
