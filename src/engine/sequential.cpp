// SPDX-License-Identifier: MIT
// The sequential engine: one thread, one frontier, the expander, the primal search and the gate.
// CTS-CBS (paper, Algorithms 1 and 4); the proof that it may stop is at the head of
// search/gate.cpp. The primal search (primal_share.cpp tells when it is its turn) posts plans like
// any node: an incumbent prunes, and that is all it does.
//
// Which node. With w = 0 always the best. With w > 0 a plan may be found that no proof has to wait
// for, in nodes whose bound is within w of the lower bound; among these the best is the worst
// place to look, for it has been kept from becoming dearer, not from having conflicts. So, as in
// explicit estimation search (Li, Ruml and Koenig, AAAI 2021), every other node is chosen by what a
// plan below it can be expected to cost, and the nodes between, best first, let the bound rise.
// Once there is an incumbent C only the bound is of use: every node below C / (1 + w) must be
// expanded in whatever order, and what the tree finds no sooner than neighbourhood search does is
// not worth a node above. Then it is best first as with w = 0.
#include <malloc.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "grove/engine/run_observer.h"
#include "grove/engine/solve.h"
#include "grove/primal/primal_search.h"
#include "grove/search/expander.h"
#include "grove/search/feasibility.h"
#include "grove/search/frontier.h"
#include "grove/search/gate.h"
#include "grove/search/sequence_forest.h"
#include "grove/search/single_tree.h"
#include "memory_shares.h"
#include "primal_share.h"

namespace grove {
namespace {

std::unique_ptr<Forest> make_forest(const Problem& problem, AgentStopsStore& stops, NodePool& pool,
                                    const SolveOptions& options, const Limits& limits) {
  if (options.policy == Policy::kFixed)
    return std::make_unique<SequenceForest>(problem, pool, options.rtsp, limits);
  return std::make_unique<SingleTree>(problem, stops, pool, limits);
}

// The paper's policy is the cross-check: plain CBS.
Techniques techniques_of(const SolveOptions& options) {
  return options.policy == Policy::kFixed ? Techniques() : options.techniques;
}

constexpr std::int64_t kRootWorkPerPair = 8;  // of agents
constexpr std::int64_t kWorkPerCall = 16;  // in labels: what a call of the low level costs beside
constexpr double kExpectedPerConflict = 0.5;  // by measurement; 1 is a little worse, 0.15 much
constexpr std::int64_t kStepsPerWork = 4;     // of the paths of a node that is looked through

class SequentialEngine {
 public:
  SequentialEngine(const Problem& problem, const SolveOptions& options, const Limits& limits,
                   RunObserver& observer)
      : problem_(problem),
        options_(options),
        limits_(limits),
        observer_(observer),
        omega_(options.omega),
        gate_(problem.instance, options.omega),
        stops_(problem.instance, problem.distances),
        forest_(make_forest(problem, stops_, pool_, options, limits)),
        expander_(problem, stops_, techniques_of(options), options.seed),
        share_(problem.instance.agent_count()),
        memory_(limits, options.node_memory),
        uses_estimates_(techniques_of(options).has(Technique::kEstimates)) {}
  ~SequentialEngine() { frontier_.abandon(); }
  SequentialEngine(const SequentialEngine&) = delete;
  SequentialEngine& operator=(const SequentialEngine&) = delete;

  Solution run();

 private:
  void search();
  bool primal_is_due();
  void step_primal();
  void work_on_tree();
  void begin_tree();
  NodePtr select();
  void grow();
  bool plan_is_wanted();
  bool begin_anew();
  void keep_within_memory();
  void evict_to(std::size_t bytes);
  void expand(const NodePtr& node);
  void branch(const Expansion& expansion);
  void post(Plan plan, PlanSource source);
  void update_bound();
  void tell(RunEvent event) { observer_.on_event(event, progress()); }
  Progress progress() const;
  Solution conclude() const;

  const Problem& problem_;
  const SolveOptions& options_;
  const Limits& limits_;
  RunObserver& observer_;
  const Omega omega_;
  Gate gate_;
  AgentStopsStore stops_;
  NodePool pool_;
  std::unique_ptr<Forest> forest_;
  Frontier frontier_;
  Expander expander_;
  std::unique_ptr<PrimalSearch> primal_;  // made when it is first due
  PrimalShare share_;
  MemoryShares memory_;
  std::vector<NodePtr> roots_;  // of all trees so far
  Cost begun_anew_at_ = -1;     // the bound that the last run through the trees proved
  bool begun_ = false;          // the first root was asked for
  bool out_of_nodes_ = false;   // though not finished
  std::int64_t nodes_expanded_ = 0;
  std::int64_t nodes_generated_ = 0;
  std::int64_t nodes_evicted_ = 0;
  std::int64_t restarts_ = 0;
  const bool uses_estimates_;
  bool estimates_turn_ = false;
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
  if (options_.start) post(*options_.start, PlanSource::kStart);
  while (!gate_.finished() && !out_of_nodes_ && !limits_.stop_requested()) {
    if (primal_is_due())
      step_primal();
    else
      work_on_tree();
    keep_within_memory();
    tell(RunEvent::kProgress);
  }
}

bool SequentialEngine::primal_is_due() {
  const bool wanted =
      options_.policy != Policy::kFixed && options_.techniques.has(Technique::kPrimal);
  if (!wanted || !share_.may_begin()) return false;
  if (!primal_) {
    primal_ = std::make_unique<PrimalSearch>(problem_, stops_, options_.seed, options_.techniques);
    if (const auto plan = gate_.incumbent()) primal_->adopt(*plan);
  }
  return share_.due(*primal_);
}

void SequentialEngine::step_primal() {
  const std::int64_t before = primal_->work();
  std::optional<Plan> plan = primal_->step(limits_);
  if (plan) post(std::move(*plan), primal_->source());
  share_.primal_worked(*primal_, primal_->work() - before);
}

void SequentialEngine::work_on_tree() {
  if (!begun_) return begin_tree();
  const NodePtr node = select();
  if (!node) {
    out_of_nodes_ = true;
    return;
  }
  const ExpansionCounts before = expander_.counts();
  expand(node);
  const ExpansionCounts after = expander_.counts();
  share_.tree_worked(after.low_level_expanded - before.low_level_expanded +
                     kWorkPerCall * (after.low_level_calls - before.low_level_calls) +
                     node->cost() / kStepsPerWork + 1);
  update_bound();
}

// The first root is a turn of its own: to expand it can take long where there are many pairs of
// agents, which is what it counts for.
void SequentialEngine::begin_tree() {
  begun_ = true;
  grow();
  const std::int64_t agents = problem_.instance.agent_count();
  share_.tree_worked(kRootWorkPerPair * agents * agents);
}

// The node to expand next, after instantiating the next tree where Algorithm 4 finds that
// necessary.
NodePtr SequentialEngine::select() {
  if (gate_.needs_new_tree(frontier_.bound(), forest_->last_cost())) grow();
  NodePtr node;
  if (plan_is_wanted())
    node = frontier_.take_promising(omega_, gate_.lower_bound(), kExpectedPerConflict);
  if (!node) node = frontier_.take();
  if (!node && begin_anew()) node = frontier_.take();
  return node;
}

// Is it the turn of a node that may lead to a plan soon?
bool SequentialEngine::plan_is_wanted() {
  if (omega_ == Omega() || gate_.incumbent_cost() || !uses_estimates_) return false;
  estimates_turn_ = !estimates_turn_;
  return estimates_turn_;
}

// When no node is left but some were given up: starts again from all roots, or first adds a tree
// that is due by then. False if that would lead nowhere: the last run was no better.
bool SequentialEngine::begin_anew() {
  const Cost proven = frontier_.evicted_bound();
  if (proven == kInfiniteCost || omega_.is_infinite()) return false;
  if (forest_->next_bound() < proven) {
    grow();
    return true;
  }
  if (proven <= begun_anew_at_) return false;
  begun_anew_at_ = proven;
  ++restarts_;
  frontier_.restart();
  for (const NodePtr& root : roots_) {
    observer_.on_root(root);
    if (!gate_.prunes(root->bound())) frontier_.push(root);
  }
  return true;
}

void SequentialEngine::grow() {
  const NodePtr root = forest_->next_root();
  if (root) {
    observer_.on_root(root);
    roots_.push_back(root);
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
  if (expansion.plan) post(std::move(*expansion.plan), PlanSource::kTree);
  frontier_.settle(node);
}

void SequentialEngine::branch(const Expansion& expansion) {
  for (const NodePtr& child : expansion.children) {
    ++nodes_generated_;
    if (!gate_.prunes(child->bound())) frontier_.push(child);
  }
}

// Nodes that need not be expanded any more, for the incumbent is within w of their bound, are the
// first to go: they are the worst.
void SequentialEngine::keep_within_memory() {
  if (memory_.is_short()) {
    memory_.cut(pool_.bytes(), expander_.memory());
    expander_.limit_memory(memory_.for_expander());
    evict_to(memory_.for_nodes());
    ::malloc_trim(0);
    memory_.settled();
  } else if (pool_.bytes() > memory_.for_nodes()) {
    evict_to(memory_.for_nodes() / 8 * 7);
  }
}

// The best open node stays. Evicting a leaf frees those ancestors that no other node shares.
void SequentialEngine::evict_to(std::size_t bytes) {
  while (pool_.bytes() > bytes && frontier_.open() > 1) {
    const std::size_t open = frontier_.open();
    const auto evicted = frontier_.evict(std::min(open - 1, open / 16 + 1));
    for (const NodePtr& node : evicted) observer_.on_evicted(node);
    nodes_evicted_ += std::ssize(evicted);
  }
}

void SequentialEngine::post(Plan plan, PlanSource source) {
  const Cost cost = plan.cost;
  if (!gate_.post(std::move(plan))) return;
  frontier_.prune(cost);
  observer_.on_pruned(cost);
  const std::optional<Plan> kept = gate_.incumbent();
  if (primal_) primal_->adopt(*kept);
  observer_.on_incumbent(*kept, source, progress());
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
                           {"nodes_evicted", nodes_evicted_},
                           {"restarts", restarts_},
                           {"roots_generated", forest_->trees()},
                           {"rtsp_calls", forest_->rtsp_calls()},
                           {"low_level_calls", counts.low_level_calls},
                           {"low_level_expanded", counts.low_level_expanded},
                           {"pair_expansions", counts.pair_expansions}};
  solution.stats.measures["node_bytes"] = pool_.mean_bytes();
  const auto primal = primal_ ? primal_->counts() : PrimalSearch::Counts();
  solution.stats.counts["primal_steps"] = primal.steps;
  solution.stats.counts["primal_attempts"] = primal.attempts;
  solution.stats.counts["primal_joint_steps"] = primal.joint_steps;
  solution.stats.counts["primal_neighborhoods"] = primal.neighborhoods;
  solution.stats.counts["primal_low_level_calls"] = primal.low_level_calls;
  solution.stats.counts["primal_low_level_expanded"] = primal.low_level_expanded;
  // A limit that struck after the search had ended changed nothing.
  if (!gate_.finished()) {
    const std::string stop = stop_text(limits_.reason());
    const bool evicted = frontier_.evicted_bound() < kInfiniteCost;
    solution.stats.texts["stopped_by"] = !stop.empty() ? stop
                                         : evicted     ? stop_text(StopReason::kMemory)
                                                       : "first tree exhausted";
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

// A limit struck before there was a bound: all there may be is the plan that was given.
Solution stopped_before_search(const Instance& instance, const SolveOptions& options,
                               const Limits& limits, RunObserver& observer) {
  Solution solution =
      without_search(options, Status::kUnknown, "stopped_by", stop_text(limits.reason()));
  if (!options.start) return solution;
  Gate gate(instance, options.omega);
  gate.post(*options.start);
  solution.plan = gate.incumbent();
  solution.status = status_of(solution.plan->cost, solution.lower_bound, options.omega);
  observer.on_incumbent(*solution.plan, PlanSource::kStart,
                        Progress{0, 0, 0, 0, solution.plan->cost});
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
      return stopped_before_search(instance, options, limits, watcher);
    if (const auto reason = evident_infeasibility(problem)) {
      watcher.on_infeasible(*reason);
      return without_search(options, Status::kInfeasible, "reason", *reason);
    }
    return SequentialEngine(problem, options, limits, watcher).run();
  } catch (const std::bad_alloc&) {  // before the search: nothing is known yet
    limits.memory_exhausted();
    return stopped_before_search(instance, options, limits, watcher);
  }
}

}  // namespace grove
