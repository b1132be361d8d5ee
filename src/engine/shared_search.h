// SPDX-License-Identifier: MIT
// What the workers of a run have in common.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "grove/engine/run_observer.h"
#include "grove/engine/solve.h"
#include "grove/search/expander.h"
#include "grove/search/forest.h"
#include "grove/search/frontier.h"
#include "grove/search/gate.h"
#include "memory_shares.h"

namespace grove {

// The gate, the forest, the frontier and the observer of one run. CTS-CBS (paper, Algorithms 1 and
// 4) is what happens when workers take nodes here and bring back what they led to; the arguments
// are at the head of the .cpp. All methods may be called from any thread unless they say otherwise;
// none waits longer than it takes another to do the like.
class SharedSearch {
 public:
  // All must outlive this.
  SharedSearch(const Problem& problem, const SolveOptions& options, const Limits& limits,
               RunObserver& observer);
  ~SharedSearch();
  SharedSearch(const SharedSearch&) = delete;
  SharedSearch& operator=(const SharedSearch&) = delete;

  // Before all else, from one thread: the plan to start from.
  void begin();
  // What the first tree found out about the agents' stops, for workers to begin with.
  const AgentStopsStore& stops() const { return stops_; }
  // Is there nothing left to do, or no time to do it?
  bool over() const;

  // A node to expand; null if there is none just now. Whoever takes it brings it back by finish().
  // Instantiates the next tree where Algorithm 4 finds that necessary.
  NodePtr take();
  // What became of a node taken.
  void finish(const NodePtr& node, Expansion expansion);
  // A node, perhaps in other hands, that came back unfinished last; null if it has been finished.
  NodePtr unfinished() const;
  // May the caller prepare the next tree before Algorithm 4 asks for it? Whoever is told so must do
  // it. One at a time.
  bool claim_preparation();
  void prepare_tree();
  // A plan from elsewhere.
  void post(Plan plan, PlanSource source);

  // Is there something for an idle worker to take, or to find out?
  bool may_take() const { return frontier_.open() > 0 || frontier_.live() == 0; }
  // Nodes that cost so much or more are of no use.
  Cost cutoff() const { return gate_.incumbent_cost().value_or(kInfiniteCost); }
  // The incumbent if it is cheaper than `cost`.
  std::optional<Plan> plan_below(Cost cost) const;

  // Gives up nodes, and what was found out, as memory demands.
  void keep_within_memory();
  // What was found out, for expanders to go on with.
  std::shared_ptr<CommonMemory> memory() const { return known_.load(); }

  // Tells the observer. kEnd once, when no worker is at work any more.
  void tell(RunEvent event);

  // The answer, with the counts of the tree's side. When no worker is at work any more.
  Solution conclude() const;

 private:
  bool needs_tree() const;
  void grow();
  bool begin_anew();
  NodePtr take_open();
  bool plan_is_wanted();
  void evict_to(std::size_t bytes);
  void update_bound();
  // Observers are told one thing at a time.
  template <class Tell>
  void watch(Tell what) {
    const std::lock_guard lock(observing_);
    what();
  }
  Progress progress() const;

  const SolveOptions& options_;
  const Limits& limits_;
  RunObserver& observer_;
  const Omega omega_;
  const bool uses_estimates_;
  Gate gate_;
  AgentStopsStore stops_;  // the forest's
  NodePool pool_;
  std::unique_ptr<Forest> forest_;
  Frontier frontier_;

  std::mutex growing_;  // guards the forest and what follows
  std::vector<NodePtr> roots_;
  NodePtr prepared_;         // of the next tree, if it has been prepared
  Cost begun_anew_at_ = -1;  // the bound that the last run through the trees proved
  std::int64_t restarts_ = 0;

  std::atomic<Cost> next_tree_bound_;
  std::atomic<Cost> last_tree_cost_;
  std::atomic<std::int64_t> trees_{0};
  std::atomic<bool> preparing_{false};
  std::atomic<std::int64_t> trees_prepared_{0};
  std::atomic<bool> out_of_nodes_{false};  // though not finished
  std::atomic<std::int64_t> nodes_expanded_{0};
  std::atomic<std::int64_t> nodes_generated_{0};
  std::atomic<std::int64_t> nodes_evicted_{0};
  std::atomic<std::uint32_t> estimates_turn_{0};

  std::mutex keeping_;  // guards the shares
  MemoryShares shares_;
  std::atomic<std::shared_ptr<CommonMemory>> known_;

  mutable std::mutex helping_;
  NodePtr unfinished_;  // under helping_

  std::mutex posting_;  // orders what is announced of plans
  std::mutex observing_;
  Cost announced_bound_ = 0;  // under observing_
};

}  // namespace grove
