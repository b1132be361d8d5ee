// SPDX-License-Identifier: MIT
// The sequential engine: one thread, one frontier, the expander and the gate. CTS-CBS (paper,
// Algorithms 1 and 4); the proof that it may stop is at the head of search/gate.cpp.
#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "grove/engine/run_observer.h"
#include "grove/engine/solve.h"
#include "grove/search/expander.h"
#include "grove/search/feasibility.h"
#include "grove/search/frontier.h"
#include "grove/search/gate.h"
#include "grove/search/sequence_forest.h"
#include "grove/search/single_tree.h"

namespace grove {
namespace {

std::unique_ptr<Forest> make_forest(const Problem& problem, NodePool& pool,
                                    const SolveOptions& options, const Limits& limits) {
  if (options.policy == Policy::kFixed)
    return std::make_unique<SequenceForest>(problem, pool, options.rtsp, limits);
  return std::make_unique<SingleTree>(problem, pool, limits);
}

// The paper's policy is the cross-check: plain CBS.
Techniques techniques_of(const SolveOptions& options) {
  return options.policy == Policy::kFixed ? Techniques() : options.techniques;
}

class SequentialEngine {
 public:
  SequentialEngine(const Problem& problem, const SolveOptions& options, const Limits& limits,
                   RunObserver& observer)
      : limits_(limits),
        observer_(observer),
        omega_(options.omega),
        gate_(problem.instance, options.omega),
        forest_(make_forest(problem, pool_, options, limits)),
        expander_(problem, techniques_of(options), options.seed) {}
  ~SequentialEngine() { frontier_.abandon(); }
  SequentialEngine(const SequentialEngine&) = delete;
  SequentialEngine& operator=(const SequentialEngine&) = delete;

  Solution run();

 private:
  void search();
  NodePtr select();
  void grow();
  void expand(const NodePtr& node);
  void branch(const Expansion& expansion);
  void post(Plan plan);
  void update_bound();
  void tell(RunEvent event) { observer_.on_event(event, progress()); }
  Progress progress() const;
  Solution conclude() const;

  const Limits& limits_;
  RunObserver& observer_;
  const Omega omega_;
  Gate gate_;
  NodePool pool_;
  std::unique_ptr<Forest> forest_;
  Frontier frontier_;
  Expander expander_;
  std::int64_t nodes_expanded_ = 0;
  std::int64_t nodes_generated_ = 0;
};

Solution SequentialEngine::run() {
  try {
    search();
  } catch (const std::bad_alloc&) {
    limits_.memory_exhausted();
  }
  tell(RunEvent::kEnd);
  return conclude();
}

void SequentialEngine::search() {
  update_bound();
  while (!gate_.finished() && !limits_.stop_requested()) {
    const NodePtr node = select();
    if (!node) break;
    expand(node);
    update_bound();
    tell(RunEvent::kProgress);
  }
}

// The node to expand next, after instantiating the next tree where Algorithm 4 finds that
// necessary.
NodePtr SequentialEngine::select() {
  if (gate_.needs_new_tree(frontier_.bound(), forest_->last_cost())) grow();
  return frontier_.take();
}

void SequentialEngine::grow() {
  const NodePtr root = forest_->next_root();
  if (root) {
    observer_.on_root(root);
    ++nodes_generated_;
    if (!gate_.prunes(root->bound())) frontier_.push(root);
  }
  update_bound();
  if (root) tell(RunEvent::kTree);
}

void SequentialEngine::expand(const NodePtr& node) {
  Expansion expansion =
      expander_.expand(node, gate_.incumbent_cost().value_or(kInfiniteCost), limits_);
  if (expansion.stopped) {
    frontier_.give_back(node);
    return;
  }
  ++nodes_expanded_;
  observer_.on_expanded(node, expansion);
  branch(expansion);
  if (expansion.plan) post(std::move(*expansion.plan));
  frontier_.settle(node);
}

void SequentialEngine::branch(const Expansion& expansion) {
  for (const NodePtr& child : expansion.children) {
    ++nodes_generated_;
    if (!gate_.prunes(child->bound())) frontier_.push(child);
  }
}

void SequentialEngine::post(Plan plan) {
  const Cost cost = plan.cost;
  if (!gate_.post(std::move(plan))) return;
  frontier_.prune(cost);
  observer_.on_pruned(cost);
  tell(RunEvent::kIncumbent);
}

void SequentialEngine::update_bound() {
  const Cost before = gate_.lower_bound();
  gate_.update(frontier_.bound(), forest_->next_bound());
  if (gate_.lower_bound() > before) tell(RunEvent::kBound);
}

Progress SequentialEngine::progress() const {
  return {nodes_expanded_, static_cast<std::int64_t>(frontier_.open()), forest_->trees(),
          gate_.lower_bound(), gate_.incumbent_cost()};
}

std::string stop_text(StopReason reason) {
  switch (reason) {
    case StopReason::kTime:
      return "time limit";
    case StopReason::kMemory:
      return "memory limit";
    case StopReason::kInterrupt:
      return "interrupt";
    case StopReason::kNone:
      break;
  }
  return "";
}

Solution SequentialEngine::conclude() const {
  Solution solution;
  solution.omega = omega_;
  solution.plan = gate_.incumbent();
  solution.lower_bound = gate_.lower_bound();
  solution.status = status_of(gate_.incumbent_cost(), solution.lower_bound, omega_);
  if (gate_.proven_infeasible()) {
    solution.status = Status::kInfeasible;
    solution.lower_bound = 0;
  }
  const ExpansionCounts counts = expander_.counts();
  solution.stats.counts = {{"nodes_expanded", nodes_expanded_},
                           {"nodes_generated", nodes_generated_},
                           {"roots_generated", forest_->trees()},
                           {"rtsp_calls", forest_->rtsp_calls()},
                           {"low_level_calls", counts.low_level_calls},
                           {"low_level_expanded", counts.low_level_expanded},
                           {"pair_expansions", counts.pair_expansions}};
  // A limit that struck after the search had ended changed nothing.
  if (!gate_.finished()) {
    const std::string stop = stop_text(limits_.reason());
    solution.stats.texts["stopped_by"] = stop.empty() ? "first tree exhausted" : stop;
  }
  return solution;
}

Solution without_search(const SolveOptions& options, Status status, const std::string& key,
                        const std::string& text) {
  Solution solution;
  solution.status = status;
  solution.omega = options.omega;
  solution.stats.texts[key] = text;
  return solution;
}

}  // namespace

Solution solve(const Instance& instance, const SolveOptions& options, const Limits& limits,
               RunObserver* observer) {
  RunObserver silent;
  RunObserver& watcher = observer ? *observer : silent;
  try {
    const Problem problem(instance, limits);
    if (!problem.distances.complete())
      return without_search(options, Status::kUnknown, "stopped_by", stop_text(limits.reason()));
    if (const auto reason = evident_infeasibility(problem)) {
      watcher.on_infeasible(*reason);
      return without_search(options, Status::kInfeasible, "reason", *reason);
    }
    return SequentialEngine(problem, options, limits, watcher).run();
  } catch (const std::bad_alloc&) {  // before the search: nothing is known yet
    limits.memory_exhausted();
    return without_search(options, Status::kUnknown, "stopped_by", stop_text(limits.reason()));
  }
}

}  // namespace grove
