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
#include "grove/engine/central_ledger.h"

#include <algorithm>
#include <string>
#include <utility>

#include "grove/io/input_error.h"
#include "grove/model/fingerprint.h"
#include "grove/search/sequence_forest.h"
#include "grove/search/single_tree.h"
#include "stop_text.h"

namespace grove {
namespace {

constexpr Cost kNoTree = -1;

bool same_sequences(const Tree& a, const Tree& b) {
  return std::ranges::equal(a.orders, b.orders, {}, &AgentOrder::sequences, &AgentOrder::sequences);
}

std::unique_ptr<Forest> make_forest(const Problem& problem, AgentStopsStore& stops, NodePool& pool,
                                    const SolveOptions& options, const Limits& limits) {
  if (options.policy == Policy::kFixed)
    return std::make_unique<SequenceForest>(problem, pool, options.rtsp, limits);
  return std::make_unique<SingleTree>(problem, stops, pool, limits);
}

}  // namespace

CentralLedger::CentralLedger(const Problem& problem, const SolveOptions& options,
                             const Limits& limits, RunObserver& observer, NodePool& pool,
                             LiveNodes& nodes)
    : options_(options),
      limits_(limits),
      observer_(observer),
      nodes_(nodes),
      instance_(problem.instance),
      omega_(options.omega),
      gate_(problem.instance, options.omega),
      stops_(problem.instance, problem.distances),
      forest_(make_forest(problem, stops_, pool, options, limits)),
      restored_trees_(problem, stops_, pool),
      next_tree_bound_(forest_->next_bound()),
      last_tree_cost_(kNoTree) {}

CentralLedger::~CentralLedger() = default;

void CentralLedger::begin() {
  nodes_changed();
  if (options_.start) post(*options_.start, PlanSource::kStart);
  const std::lock_guard lock(growing_);
  if (!over()) grow();
}

// Nothing is said of the nodes before they have been pushed: no bound is taken from their absence.
std::optional<std::vector<NodePtr>> CentralLedger::restore(const CheckpointHeader& header) {
  resumed_ = true;
  before_.counters = header.counters;
  before_.seconds = header.seconds;
  gate_.update(header.lower_bound, header.lower_bound);
  announced_bound_ = header.lower_bound;
  if (header.incumbent) post(*header.incumbent, PlanSource::kStart);
  if (options_.start) post(*options_.start, PlanSource::kStart);
  const std::lock_guard lock(growing_);
  for (const TreeRecord& tree : header.trees) {
    const NodePtr same = forest_->next_root();
    if (!same && limits_.stop_requested()) return std::nullopt;
    const NodePtr root = restored_trees_.add(tree, static_cast<std::uint32_t>(roots_.size()));
    if (!same || !same_sequences(same->tree(), root->tree()))
      throw InputError(
          checkpoint_file(options_.checkpoints.directory).string(), "",
          "its trees come in another order than they do here; expected the same --rtsp");
    roots_.push_back(root);
    watch([&] { observer_.on_root(root); });
    last_tree_cost_ = root->cost();
    ++trees_;
  }
  next_tree_bound_ = forest_->next_bound();
  return roots_;
}

void CentralLedger::restored() {
  nodes_changed();
  const std::lock_guard lock(growing_);
  if (roots_.empty() && !over()) grow();
}

CheckpointHeader CentralLedger::checkpoint_header(std::int64_t trees, Cost evicted_bound) {
  CheckpointHeader header;
  header.fingerprint = fingerprint(instance_);
  header.policy = options_.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
  header.incumbent = gate_.incumbent();
  header.lower_bound = gate_.lower_bound();
  header.evicted_bound = evicted_bound;
  header.trees_instantiated = trees;
  header.counters["nodes_expanded"] = nodes_before() + nodes_.counts().expanded;
  header.seconds = before_.seconds + std::chrono::duration<double>(Clock::now() - started_).count();
  const std::lock_guard lock(growing_);
  for (std::int64_t i = 0; i < trees; ++i)
    header.trees.push_back(record_of(roots_[static_cast<std::size_t>(i)]->tree()));
  return header;
}

std::int64_t CentralLedger::nodes_before() const {
  const auto found = before_.counters.find("nodes_expanded");
  return found == before_.counters.end() ? 0 : found->second;
}

void CentralLedger::checkpointed(const CheckpointReport& report) {
  watch([&] { observer_.on_checkpoint(report); });
}

bool CentralLedger::over() const {
  return gate_.finished() || out_of_nodes_ || limits_.stop_requested();
}

std::optional<Plan> CentralLedger::plan_below(Cost cost) const {
  if (cutoff() >= cost) return std::nullopt;
  return gate_.incumbent();
}

void CentralLedger::post(Plan plan, PlanSource source) {
  const std::lock_guard lock(posting_);
  const Cost cost = plan.cost;
  if (!gate_.post(std::move(plan))) return;
  watch([&] {
    observer_.on_pruned(cost);
    observer_.on_incumbent(*gate_.incumbent(), source, progress());
  });
  nodes_.prune(cost);
  tell(RunEvent::kIncumbent);
}

void CentralLedger::nodes_changed() {
  const Cost next_tree = next_tree_bound_;  // before the nodes': see above
  gate_.update(nodes_.bound(), next_tree);
  watch([&] {
    if (gate_.lower_bound() <= announced_bound_) return;
    announced_bound_ = gate_.lower_bound();
    observer_.on_event(RunEvent::kBound, progress());
  });
}

void CentralLedger::expanded(const NodePtr& node, const Expansion& expansion) {
  watch([&] { observer_.on_expanded(node, expansion); });
}

void CentralLedger::evicted(std::span<const NodePtr> nodes) {
  watch([&] {
    for (const NodePtr& node : nodes) observer_.on_evicted(node);
  });
}

void CentralLedger::bring_due_tree() {
  if (!needs_tree()) return;
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (lock && needs_tree()) grow();
}

void CentralLedger::bring_nodes() {
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (!lock || nodes_.any()) return;
  if (needs_tree())
    grow();
  else if (!begin_anew())
    out_of_nodes_ = true;
}

// Algorithm 4, where there is a tree left.
bool CentralLedger::needs_tree() const {
  const Cost last = last_tree_cost_;
  return next_tree_bound_ < kInfiniteCost &&
         gate_.needs_new_tree(nodes_.bound(), last == kNoTree ? std::nullopt : std::optional(last));
}

// Instantiates the next tree. Under growing_. If anything throws, the root stays prepared.
void CentralLedger::grow() {
  if (!prepared_) prepared_ = forest_->next_root();
  const bool has_root = prepared_ != nullptr;
  if (has_root) {
    watch([&] { observer_.on_root(prepared_); });
    roots_.push_back(prepared_);
    if (!gate_.prunes(prepared_->bound())) nodes_.push(prepared_);
    ++trees_;
    last_tree_cost_ = prepared_->cost();
  }
  next_tree_bound_ = forest_->next_bound();
  prepared_ = nullptr;
  preparing_ = false;
  nodes_changed();
  if (has_root) tell(RunEvent::kTree);
}

// The paper's trees take time to make: sequencing problems, and a path for each agent.
bool CentralLedger::claim_preparation() {
  const bool wanted = options_.policy == Policy::kFixed && !omega_.is_infinite() &&
                      next_tree_bound_ < kInfiniteCost && !over();
  return wanted && !preparing_.exchange(true);
}

// A tree that is prepared is not instantiated: its root is not live, and bounds the trees to come.
void CentralLedger::prepare_tree() {
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
bool CentralLedger::begin_anew() {
  const Cost proven = nodes_.evicted_bound();
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
  nodes_.restart(roots, proven);
  return true;
}

void CentralLedger::tell(RunEvent event) {
  watch([&] { observer_.on_event(event, progress()); });
}

Progress CentralLedger::progress() const {
  const LiveNodes::Counts counts = nodes_.counts();
  return {counts.expanded, counts.open, trees_, gate_.lower_bound(), gate_.incumbent_cost()};
}

Solution CentralLedger::conclude() const {
  Solution solution;
  solution.omega = omega_;
  solution.plan = gate_.incumbent();
  solution.lower_bound = gate_.lower_bound();
  solution.status = status_of(gate_.incumbent_cost(), solution.lower_bound, omega_);
  if (gate_.proven_infeasible()) {
    solution.status = Status::kInfeasible;
    solution.lower_bound = 0;
  }
  solution.stats.counts = {{"nodes_generated", trees_},  // the roots among them
                           {"restarts", restarts_},
                           {"roots_generated", trees_},
                           {"trees_prepared", trees_prepared_},
                           {"trees_prepared_in_vain", prepared_ ? 1 : 0},
                           {"rtsp_calls", forest_->rtsp_calls()}};
  if (resumed_) {
    solution.stats.counts["nodes_expanded_before"] = nodes_before();
    solution.stats.measures["seconds_before"] = before_.seconds;
  }
  // A limit that struck after the search had ended changed nothing.
  if (!gate_.finished()) {
    const std::string stop = stop_text(limits_.reason());
    const bool evicted = nodes_.evicted_bound() < kInfiniteCost;
    solution.stats.texts["stopped_by"] = !stop.empty() ? stop
                                         : evicted     ? stop_text(StopReason::kMemory)
                                                       : "first tree exhausted";
  }
  return solution;
}

}  // namespace grove
