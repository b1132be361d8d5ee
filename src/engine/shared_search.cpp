// SPDX-License-Identifier: MIT
// CTS-CBS (paper, Algorithms 1 and 4) among workers; the proof that it may stop is at the head of
// search/gate.cpp and holds for any order of expansion. What it asks of those who share a search:
//
// *The ledger's two numbers*, the least bound of the live nodes and the bound of the trees not yet
// instantiated, are read while others work. A tree's root is pushed first and the bound of the
// trees after it published then; and the trees' bound is read before the nodes'. So a plan in a
// tree that was not yet instantiated when the nodes' bound was read was not either when the trees'
// was read, and any other plan is in a live node, or was pruned: the minimum of the two bounds it.
// A node is live until all that it led to has been pushed.
//
// *Nothing left* is said only when no node is live and no tree is due, while nobody else may
// instantiate one: nodes come from live nodes and from new trees alone.
//
// *Pruning.* An incumbent is in the gate, checked, before anybody prunes by it.
//
// Which node. With w = 0 always the best. With w > 0 a plan may be found that no proof has to wait
// for, in nodes whose bound is within w of the lower bound; among these the best is the worst
// place to look, for it has been kept from becoming dearer, not from having conflicts. So, as in
// explicit estimation search (Li, Ruml and Koenig, AAAI 2021), every other node is chosen by what a
// plan below it can be expected to cost, and the nodes between, best first, let the bound rise.
// Once there is an incumbent C only the bound is of use: every node below C / (1 + w) must be
// expanded in whatever order, and what the tree finds no sooner than neighbourhood search does is
// not worth a node above. Then it is best first as with w = 0.
#include "shared_search.h"

#include <malloc.h>

#include <algorithm>
#include <string>
#include <utility>

#include "grove/search/sequence_forest.h"
#include "grove/search/single_tree.h"
#include "stop_text.h"
#include "techniques_of.h"

namespace grove {
namespace {

constexpr Cost kNoTree = -1;
constexpr std::size_t kMostKnown = std::size_t{1} << 29;  // bytes of what was found out
constexpr double kExpectedPerConflict = 0.5;  // by measurement; 1 is a little worse, 0.15 much

std::unique_ptr<Forest> make_forest(const Problem& problem, AgentStopsStore& stops, NodePool& pool,
                                    const SolveOptions& options, const Limits& limits) {
  if (options.policy == Policy::kFixed)
    return std::make_unique<SequenceForest>(problem, pool, options.rtsp, limits);
  return std::make_unique<SingleTree>(problem, stops, pool, limits);
}

}  // namespace

SharedSearch::SharedSearch(const Problem& problem, const SolveOptions& options,
                           const Limits& limits, RunObserver& observer)
    : options_(options),
      limits_(limits),
      observer_(observer),
      omega_(options.omega),
      uses_estimates_(techniques_of(options).has(Technique::kEstimates)),
      gate_(problem.instance, options.omega),
      stops_(problem.instance, problem.distances),
      forest_(make_forest(problem, stops_, pool_, options, limits)),
      next_tree_bound_(forest_->next_bound()),
      last_tree_cost_(kNoTree),
      shares_(limits, options.node_memory),
      known_(std::make_shared<CommonMemory>()) {}

SharedSearch::~SharedSearch() {
  frontier_.abandon();
}

void SharedSearch::begin() {
  update_bound();
  if (options_.start) post(*options_.start, PlanSource::kStart);
  const std::lock_guard lock(growing_);
  if (!over()) grow();
}

bool SharedSearch::over() const {
  return gate_.finished() || out_of_nodes_ || limits_.stop_requested();
}

NodePtr SharedSearch::take() {
  if (needs_tree()) {
    const std::unique_lock lock(growing_, std::try_to_lock);
    if (lock && needs_tree()) grow();
  }
  NodePtr node = take_open();
  if (node || frontier_.live() > 0) return node;
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (!lock || frontier_.live() > 0) return nullptr;
  if (needs_tree())
    grow();
  else if (!begin_anew())
    out_of_nodes_ = true;
  return take_open();
}

// Algorithm 4, where there is a tree left.
bool SharedSearch::needs_tree() const {
  const Cost last = last_tree_cost_;
  return next_tree_bound_ < kInfiniteCost &&
         gate_.needs_new_tree(frontier_.bound(),
                              last == kNoTree ? std::nullopt : std::optional(last));
}

// Instantiates the next tree. Under growing_. If anything throws, the root stays prepared.
void SharedSearch::grow() {
  if (!prepared_) prepared_ = forest_->next_root();
  const bool has_root = prepared_ != nullptr;
  if (has_root) {
    watch([&] { observer_.on_root(prepared_); });
    roots_.push_back(prepared_);
    if (!gate_.prunes(prepared_->bound())) frontier_.push(prepared_);
    ++nodes_generated_;
    ++trees_;
    last_tree_cost_ = prepared_->cost();
  }
  next_tree_bound_ = forest_->next_bound();
  prepared_ = nullptr;
  preparing_ = false;
  update_bound();
  if (has_root) tell(RunEvent::kTree);
}

// The paper's trees take time to make: sequencing problems, and a path for each agent.
bool SharedSearch::claim_preparation() {
  const bool wanted = options_.policy == Policy::kFixed && !omega_.is_infinite() &&
                      next_tree_bound_ < kInfiniteCost && !over();
  return wanted && !preparing_.exchange(true);
}

// A tree that is prepared is not instantiated: its root is not live, and bounds the trees to come.
void SharedSearch::prepare_tree() {
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (lock && (prepared_ || (prepared_ = forest_->next_root()))) {
    next_tree_bound_ = std::min(prepared_->bound(), forest_->next_bound());
    ++trees_prepared_;
  } else {
    preparing_ = false;
  }
}

// When no node is left but some were given up: starts again from all roots, or first adds a tree
// that is due by then. False if that would lead nowhere: the last run was no better. Under
// growing_.
bool SharedSearch::begin_anew() {
  const Cost proven = frontier_.evicted_bound();
  if (proven == kInfiniteCost || omega_.is_infinite()) return false;
  if (next_tree_bound_ < proven) {
    grow();
    return true;
  }
  if (proven <= begun_anew_at_) return false;
  begun_anew_at_ = proven;
  ++restarts_;
  std::vector<NodePtr> roots;
  for (const NodePtr& root : roots_) {
    watch([&] { observer_.on_root(root); });
    if (!gate_.prunes(root->bound())) roots.push_back(root);
  }
  frontier_.restart(roots);
  return true;
}

NodePtr SharedSearch::take_open() {
  NodePtr node;
  if (plan_is_wanted())
    node = frontier_.take_promising(omega_, gate_.lower_bound(), kExpectedPerConflict);
  return node ? node : frontier_.take();
}

// Is it the turn of a node that may lead to a plan soon?
bool SharedSearch::plan_is_wanted() {
  if (omega_ == Omega() || gate_.incumbent_cost() || !uses_estimates_) return false;
  return ++estimates_turn_ % 2 != 0;
}

NodePtr SharedSearch::unfinished() const {
  const std::lock_guard lock(helping_);
  return unfinished_;
}

void SharedSearch::finish(const NodePtr& node, Expansion expansion) {
  {
    const std::lock_guard lock(helping_);
    if (expansion.unfinished)
      unfinished_ = node;
    else if (unfinished_ == node)
      unfinished_ = nullptr;
  }
  if (expansion.stopped || expansion.unfinished) {
    frontier_.give_back(node);
    return;
  }
  ++nodes_expanded_;
  watch([&] { observer_.on_expanded(node, expansion); });
  for (const NodePtr& child : expansion.children) {
    ++nodes_generated_;
    if (!gate_.prunes(child->bound())) frontier_.push(child);
  }
  if (expansion.plan) post(std::move(*expansion.plan), PlanSource::kTree);
  frontier_.settle(node);
  update_bound();
}

void SharedSearch::post(Plan plan, PlanSource source) {
  const std::lock_guard lock(posting_);
  const Cost cost = plan.cost;
  if (!gate_.post(std::move(plan))) return;
  frontier_.prune(cost);
  watch([&] {
    observer_.on_pruned(cost);
    observer_.on_incumbent(*gate_.incumbent(), source, progress());
  });
  tell(RunEvent::kIncumbent);
}

std::optional<Plan> SharedSearch::plan_below(Cost cost) const {
  if (cutoff() >= cost) return std::nullopt;
  return gate_.incumbent();
}

void SharedSearch::update_bound() {
  const Cost next_tree = next_tree_bound_;  // before the nodes': see above
  gate_.update(frontier_.bound(), next_tree);
  watch([&] {
    if (gate_.lower_bound() <= announced_bound_) return;
    announced_bound_ = gate_.lower_bound();
    observer_.on_event(RunEvent::kBound, progress());
  });
}

// Nodes that need not be expanded any more, for the incumbent is within w of their bound, are the
// first to go: they are the worst. What was found out goes when its last user has turned away.
void SharedSearch::keep_within_memory() {
  const std::unique_lock lock(keeping_, std::try_to_lock);
  if (!lock) return;
  const std::size_t known = known_.load()->bytes();
  if (shares_.is_short()) {
    shares_.cut(pool_.bytes(), known);
    evict_to(shares_.for_nodes());
    ::malloc_trim(0);
    shares_.settled();
  } else if (pool_.bytes() > shares_.for_nodes()) {
    evict_to(shares_.for_nodes() / 8 * 7);
  }
  if (known > std::min(kMostKnown, shares_.for_expanders()))
    known_.store(std::make_shared<CommonMemory>());
}

// The best open node stays. Evicting a leaf frees those ancestors that no other node shares.
void SharedSearch::evict_to(std::size_t bytes) {
  while (pool_.bytes() > bytes && frontier_.open() > 1) {
    const auto evicted = frontier_.evict(frontier_.open() / 16 + 1, 1);
    watch([&] {
      for (const NodePtr& node : evicted) observer_.on_evicted(node);
    });
    nodes_evicted_ += std::ssize(evicted);
  }
}

void SharedSearch::tell(RunEvent event) {
  watch([&] { observer_.on_event(event, progress()); });
}

Progress SharedSearch::progress() const {
  return {nodes_expanded_, static_cast<std::int64_t>(frontier_.open()), trees_, gate_.lower_bound(),
          gate_.incumbent_cost()};
}

Solution SharedSearch::conclude() const {
  Solution solution;
  solution.omega = omega_;
  solution.plan = gate_.incumbent();
  solution.lower_bound = gate_.lower_bound();
  solution.status = status_of(gate_.incumbent_cost(), solution.lower_bound, omega_);
  if (gate_.proven_infeasible()) {
    solution.status = Status::kInfeasible;
    solution.lower_bound = 0;
  }
  solution.stats.counts = {{"nodes_expanded", nodes_expanded_},
                           {"nodes_generated", nodes_generated_},
                           {"nodes_evicted", nodes_evicted_},
                           {"restarts", restarts_},
                           {"roots_generated", trees_},
                           {"trees_prepared", trees_prepared_},
                           {"trees_prepared_in_vain", prepared_ ? 1 : 0},
                           {"rtsp_calls", forest_->rtsp_calls()}};
  solution.stats.measures["node_bytes"] = pool_.mean_bytes();
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

}  // namespace grove
