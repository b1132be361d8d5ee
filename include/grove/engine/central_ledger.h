// SPDX-License-Identifier: MIT
// The one ledger of a run: what is proven, what is found, and which tree comes next.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "grove/engine/checkpoint.h"
#include "grove/engine/ledger.h"
#include "grove/engine/run_observer.h"
#include "grove/engine/solve.h"
#include "grove/planning/agent_stops_store.h"
#include "grove/search/forest.h"
#include "grove/search/gate.h"
#include "grove/search/tree_record.h"

namespace grove {

// The gate, the forest and the observer. The arguments are at the head of the .cpp.
class CentralLedger : public Ledger {
 public:
  // All must outlive this. The nodes of trees are made in `pool`.
  CentralLedger(const Problem& problem, const SolveOptions& options, const Limits& limits,
                RunObserver& observer, NodePool& pool, LiveNodes& nodes);
  ~CentralLedger() override;

  // Before all else, from one thread: the plan to start from, and the first tree.
  void begin();
  // In place of begin(): takes over what a checkpoint knows, and makes its trees again; the roots
  // by their number there. Then push the nodes, and what was given up, and call restored(). None if
  // a limit struck: the plan and the bound are known, but there is nothing to search. Throws
  // InputError if the trees that come first here are others.
  std::optional<std::vector<NodePtr>> restore(const CheckpointHeader& header);
  void restored();
  // For a checkpoint, in which so many trees, the first ones, count as instantiated.
  CheckpointHeader checkpoint_header(std::int64_t trees, Cost evicted_bound);
  void checkpointed(const CheckpointReport& report);
  // How many trees are instantiated, and their roots pushed.
  std::int64_t trees() const { return trees_; }
  // What the first tree found out about the agents' stops, for workers to begin with.
  const AgentStopsStore& stops() const { return stops_; }

  bool over() const override;
  Cost cutoff() const override { return gate_.incumbent_cost().value_or(kInfiniteCost); }
  std::optional<Plan> plan_below(Cost cost) const override;
  Cost lower_bound() const override { return gate_.lower_bound(); }
  void post(Plan plan, PlanSource source) override;
  void nodes_changed() override;
  void expanded(const NodePtr& node, const Expansion& expansion) override;
  void evicted(std::span<const NodePtr> nodes) override;
  void worked() override { tell(RunEvent::kProgress); }
  void bring_due_tree() override;
  void bring_nodes() override;
  bool claim_preparation() override;
  void prepare_tree() override;

  // When no worker is at work any more: tells the observer that this is the end; the answer, with
  // the counts of trees.
  void end() { tell(RunEvent::kEnd); }
  Solution conclude() const;

 private:
  bool needs_tree() const;
  std::int64_t nodes_before() const;
  void grow();
  bool begin_anew();
  // Observers are told one thing at a time.
  template <class Tell>
  void watch(Tell what) {
    const std::lock_guard lock(observing_);
    what();
  }
  void tell(RunEvent event);
  Progress progress() const;

  using Clock = std::chrono::steady_clock;

  const SolveOptions& options_;
  const Limits& limits_;
  RunObserver& observer_;
  LiveNodes& nodes_;
  const Instance& instance_;
  const Omega omega_;
  Gate gate_;
  AgentStopsStore stops_;  // the forest's
  std::unique_ptr<Forest> forest_;

  Trees restored_trees_;
  const Clock::time_point started_ = Clock::now();
  bool resumed_ = false;
  CheckpointHeader before_;  // what earlier runs did: the counters and the time

  mutable std::mutex growing_;  // guards the forest and what follows
  std::vector<NodePtr> roots_;  // by the number of the tree
  NodePtr prepared_;            // of the next tree, if it has been prepared
  Cost begun_anew_at_ = -1;     // the bound that the last run through the trees proved
  std::int64_t restarts_ = 0;

  std::atomic<Cost> next_tree_bound_;
  std::atomic<Cost> last_tree_cost_;
  std::atomic<std::int64_t> trees_{0};
  std::atomic<bool> preparing_{false};
  std::atomic<std::int64_t> trees_prepared_{0};
  std::atomic<bool> out_of_nodes_{false};  // though not finished

  std::mutex posting_;  // orders what is announced of plans
  std::mutex observing_;
  Cost announced_bound_ = 0;  // under observing_
};

}  // namespace grove
