// SPDX-License-Identifier: MIT
#include "search/group_cbs.h"

#include <algorithm>
#include <iterator>
#include <unordered_set>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

// True if each split is at `root` or at a side of an earlier split.
bool are_a_tree(ProofKey root, std::span<const ProofSplit> splits) {
  std::unordered_set<ProofKey> nodes{root};
  for (const ProofSplit& split : splits) {
    if (nodes.erase(split.node) == 0) return false;
    for (const AgentConstraint& side : split.split) nodes.insert(proof_key(split.node, side));
  }
  return true;
}

}  // namespace

bool GroupCbs::solve(const NodePtr& node, std::span<const AgentIndex> group, Cost slack,
                     std::int64_t max_expansions, const Limits& limits, ExcessBound& known) {
  const Cost base = node->cost();
  // Without a cutoff a branch is pruned only if it has no path, so if all branches are pruned, the
  // excess is infinite.
  const Cost closed = base + slack + 1 >= kInfiniteCost ? kInfiniteCost : slack + 1;
  const Cost known_before = known.excess;
  Cost least_before = base;
  open_.clear();
  open_.push_back({base, node});
  written_.clear();
  for (std::int64_t i = 0; i < max_expansions && !open_.empty(); ++i) {
    const Open next = take_least();
    GROVE_ASSERT(next.cost >= least_before, "the least cost of the open nodes never falls");
    least_before = next.cost;
    known.excess = std::max(known.excess, next.cost - base);
    view_.enter(next.node, group);
    children_.clear();
    const auto outcome = brancher_.branch(view_, base + slack + 1, {}, limits, children_);
    if (outcome == Brancher::Outcome::kStopped && limits.stop_requested()) return false;
    ++expansions_;
    ++known.expansions;
    if (outcome == Brancher::Outcome::kStopped) {  // costs to go would become too large
      open_.push_back(next);
      break;
    }
    if (outcome == Brancher::Outcome::kConflictFree) {
      known.exact = true;
      GROVE_ASSERT(known.excess == next.cost - base,
                   "an exact excess is the excess of the paths found");
      break;
    }
    if (proof_ != nullptr && brancher_.branching()) log_splits(next, base, closed);
    for (NodePtr& child : children_) open_.push_back({child->cost(), std::move(child)});
  }
  const auto least = std::ranges::min_element(open_, {}, &Open::cost);
  if (!known.exact)
    known.excess = std::max(known.excess, least == open_.end() ? closed : least->cost - base);
  if (proof_ != nullptr && known.excess > known_before) log_lemma(node, group, known.excess);
  GROVE_ASSERT(known.excess <= std::max(known_before, closed),
               "a search raises the excess to at most slack + 1, or to infinity");
  open_.clear();
  return true;
}

// Ties are broken in favour of the newest node, because the search ends with the first
// conflict-free node.
GroupCbs::Open GroupCbs::take_least() {
  const auto best = std::ranges::min_element(open_.rbegin(), open_.rend(), {}, &Open::cost);
  const Open next = *best;
  open_.erase(std::next(best).base());
  return next;
}

// Stores costs relative to the cost of the initial node, until log_lemma() converts them to costs
// of the group.
void GroupCbs::log_splits(const Open& from, Cost base, Cost closed) {
  const Split& split = brancher_.branching()->split;
  ProofSplit written{proof_key(*from.node), split, {closed, closed}};
  for (const NodePtr& child : children_)
    written.costs[child->added() == split[0] ? 0 : 1] = child->cost() - base;
  GROVE_CHECK(std::ranges::min(written.costs) >= from.cost - base,
              "neither side of a split costs less than its node");
  written_.push_back(written);
}

void GroupCbs::log_lemma(const NodePtr& node, std::span<const AgentIndex> group, Cost excess) {
  GROVE_CHECK(are_a_tree(proof_key(*node), written_), "the splits of a lemma form a tree");
  view_.enter(node, group);
  const ProofLemma lemma = lemma_at(view_, group, excess);
  for (ProofSplit& split : written_)
    for (Cost& cost : split.costs) cost = std::min(kInfiniteCost, cost + lemma.bound - excess);
  proof_->lemma(lemma, proof_key(*node), written_);
}

void GroupCbs::leave() {
  open_.clear();
  children_.clear();
  view_.leave();
}

}  // namespace grove::detail
