// SPDX-License-Identifier: MIT
// Instantiates trees. The lower bound depends on the order of the steps here; see the head of
// central_bounds.cpp.
#include "engine/central_trees.h"

#include <algorithm>
#include <optional>

#include "search/proof_log.h"

namespace grove::detail {
namespace {

constexpr Cost kNoTree = -1;

}  // namespace

CentralTrees::CentralTrees(const SolveOptions& options, Forest& forest, LiveNodes& nodes,
                           CentralBounds& shared_bounds, RunEvents& run_events)
    : options_(options),
      forest_(forest),
      nodes_(nodes),
      shared_bounds_(shared_bounds),
      run_events_(run_events),
      last_cost_(kNoTree) {}

void CentralTrees::resume_with(const NodePtr& root) {
  instantiate(root);
  ++count_;
  shared_bounds_.expect_trees_from(forest_.next_bound());
}

void CentralTrees::begin() {
  const std::lock_guard lock(growing_);
  if (roots_.empty() && !shared_bounds_.over()) grow();
}

std::vector<TreeRecord> CentralTrees::records(std::int64_t count) const {
  const std::lock_guard lock(growing_);
  std::vector<TreeRecord> records;
  for (std::int64_t i = 0; i < count; ++i)
    records.push_back(record_of(roots_[static_cast<std::size_t>(i)]->tree()));
  return records;
}

void CentralTrees::add_counts(Counters& counters) const {
  counters[Counter::kNodesGenerated] += count_;  // only the roots
  counters[Counter::kRestarts] += restarts_;
  counters[Counter::kRootsGenerated] += count_;
  counters[Counter::kTreesPrepared] += prepared_count_;
  counters[Counter::kTreesPreparedUnused] += prepared_ ? 1 : 0;
  counters[Counter::kRtspCalls] += forest_.rtsp_calls();
}

void CentralTrees::instantiate_due_tree() {
  if (!is_due()) return;
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (lock && is_due()) grow();
}

void CentralTrees::refill_nodes() {
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (!lock || nodes_.any()) return;
  if (is_due())
    grow();
  else if (!restart())
    shared_bounds_.end();
}

// True if a tree is left and Algorithm 4 requires it now.
bool CentralTrees::is_due() const {
  const Cost last = last_cost_;
  return shared_bounds_.trees_from() < kInfiniteCost &&
         shared_bounds_.global_bounds().needs_new_tree(
             nodes_.bound(), last == kNoTree ? std::nullopt : std::optional(last));
}

void CentralTrees::instantiate(const NodePtr& root) {
  run_events_.root(root);
  if (options_.proof != nullptr) log_proof(*root);
  roots_.push_back(root);
  last_cost_ = root->cost();
}

void CentralTrees::log_proof(const Node& root) const {
  ProofTree tree{proof_key(root), root.cost(), {}};
  for (const auto& order : root.tree().orders) tree.sequences.push_back(order->sequences.prefix);
  options_.proof->tree(tree);
}

// Instantiates the next tree, if the forest has one. The caller must hold growing_. If a call
// throws, the root stays prepared.
void CentralTrees::grow() {
  if (!prepared_) prepared_ = forest_.next_root();
  const bool has_root = prepared_ != nullptr;
  if (has_root) {
    instantiate(prepared_);
    if (!shared_bounds_.global_bounds().prunes(prepared_->bound())) nodes_.push(prepared_);
    ++count_;
  }
  shared_bounds_.expect_trees_from(forest_.next_bound());
  prepared_ = nullptr;
  preparing_ = false;
  shared_bounds_.nodes_changed();
  if (has_root) run_events_.event(RunEvent::kTree);
}

// Only trees of policy kFixed are prepared, because making one is expensive: it solves sequencing
// problems and plans a path for each agent.
bool CentralTrees::claim_preparation() {
  const bool wanted = options_.policy == Policy::kFixed && !options_.omega.is_infinite() &&
                      shared_bounds_.trees_from() < kInfiniteCost && !shared_bounds_.over();
  return wanted && !preparing_.exchange(true);
}

// A prepared tree does not count as instantiated: its root is not live, but its bound is part of
// the bound of the trees not yet instantiated.
void CentralTrees::prepare_tree() {
  const std::unique_lock lock(growing_, std::try_to_lock);
  if (lock && (prepared_ || (prepared_ = forest_.next_root()))) {
    shared_bounds_.expect_trees_from(std::min(prepared_->bound(), forest_.next_bound()));
    ++prepared_count_;
  } else {
    preparing_ = false;
  }
}

// Must be called only when no node is live, with growing_ held. If nodes were evicted, restarts
// from all roots. If the bound of the trees not yet instantiated is below the bound of the evicted
// nodes, only instantiates the next tree instead. Returns false if no node was evicted, if w = inf,
// or if the search since the last restart has not raised evicted_bound().
bool CentralTrees::restart() {
  const Cost proven = nodes_.evicted_bound();
  if (proven == kInfiniteCost || options_.omega.is_infinite()) return false;
  if (shared_bounds_.trees_from() < proven) {
    grow();
    return true;
  }
  if (proven <= restarted_at_) return false;
  restarted_at_ = proven;
  ++restarts_;
  std::vector<NodePtr> roots;
  for (const NodePtr& root : roots_) {
    run_events_.root(root);
    if (!shared_bounds_.global_bounds().prunes(root->bound())) roots.push_back(root);
  }
  nodes_.restart(roots, proven);
  return true;
}

}  // namespace grove::detail
