// SPDX-License-Identifier: MIT
// Weighted pairwise dependencies (Li, Felner, Boyarski, Ma and Koenig, IJCAI 2019).
//
// For two agents whose paths conflict at a node, a small CBS over these two alone - the same
// splitting as everywhere, with only their conflicts in view - finds how much more than now they
// cost together at least. It starts at the node, so it respects all that the node demands of them.
// *Claim: every plan that obeys the node's constraints costs these two agents, together, at least
// the least cost among the open nodes of that search.* Splitting loses no plan, and what the others
// do cannot make the two cheaper. So a search that is given up early leaves a valid bound, and one
// whose first node is conflict-free the exact value. A child that is closed because it costs
// `slack` more or above leaves "slack + 1" behind.
//
// What one pair costs more and what another does may be the same steps of a shared agent; the least
// total that fulfils all statements is what covering_bound() finds.
//
// Memory. The excess of a pair depends on the situations of the two agents alone. From a node to
// its child one situation changes, so nearly all pairs are known; and pairs that do not conflict
// now, but did in the same situations at some node, count as well.
#include "grove/search/dependencies.h"

#include <algorithm>
#include <array>

namespace grove {
namespace {

constexpr std::int32_t kExpansionsPerPair = 16;

}  // namespace

Dependencies::Dependencies(const Problem& problem, Techniques techniques, std::uint64_t seed,
                           PathPlanner& planner, Situations& situations)
    : agents_(problem.instance.agent_count()),
      pair_view_(problem, techniques, seed, planner, situations),
      situation_(static_cast<std::size_t>(agents_)) {}

std::optional<Cost> Dependencies::bound(const NodePtr& node, Brancher& view, Cost cutoff,
                                        const Limits& limits) {
  const Cost slack = cutoff - node->cost() - 1;
  if (slack < 0) return cutoff;
  for (AgentIndex agent = 0; agent < agents_; ++agent) situation_[agent] = view.situation(agent);
  if (!solve_conflicting(node, view, slack, limits)) return std::nullopt;
  std::vector<GroupExcess> statements;
  collect(statements);
  return std::min(cutoff, node->cost() + covering_bound(statements));
}

std::uint64_t Dependencies::key(AgentIndex a, AgentIndex b) const {
  return static_cast<std::uint64_t>(situation_[a]) << 32 |
         static_cast<std::uint32_t>(situation_[b]);
}

// Looks into every pair that conflicts at the node. False when a limit struck.
bool Dependencies::solve_conflicting(const NodePtr& node, Brancher& view, Cost slack,
                                     const Limits& limits) {
  std::vector<std::pair<AgentIndex, AgentIndex>> pairs;
  for (const Conflict& c : view.conflicts()) pairs.emplace_back(c.first, c.second);
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  for (const auto& [a, b] : pairs) {
    Known& known = known_[key(a, b)];
    if (known.exact || known.excess > slack || known.expansions > 0) continue;
    if (!solve(node, a, b, slack, limits, known)) return false;
  }
  return true;
}

bool Dependencies::solve(const NodePtr& node, AgentIndex a, AgentIndex b, Cost slack,
                         const Limits& limits, Known& known) {
  const std::array<AgentIndex, 2> scope{a, b};
  const Cost base = node->cost();
  open_.clear();
  open_.push_back({base, node});
  for (std::int32_t i = 0; i < kExpansionsPerPair && !open_.empty(); ++i) {
    // Of equal cost the newest: the first conflict-free node ends the search.
    const auto best = std::ranges::min_element(open_.rbegin(), open_.rend(), {}, &Open::cost);
    const Open next = *best;
    open_.erase(std::next(best).base());
    known.excess = std::max(known.excess, next.cost - base);
    pair_view_.enter(next.node, scope);
    children_.clear();
    const auto outcome = pair_view_.branch(base + slack + 1, limits, children_);
    if (outcome == Brancher::Outcome::kStopped) return false;
    ++expansions_;
    ++known.expansions;
    if (outcome == Brancher::Outcome::kConflictFree) {
      known.exact = true;
      return true;
    }
    for (NodePtr& child : children_) open_.push_back({child->cost(), std::move(child)});
  }
  const auto least = std::ranges::min_element(open_, {}, &Open::cost);
  known.excess = std::max(known.excess, least == open_.end() ? slack + 1 : least->cost - base);
  open_.clear();
  return true;
}

// Every pair that is known to cost more in its present situations.
void Dependencies::collect(std::vector<GroupExcess>& statements) const {
  for (AgentIndex a = 0; a < agents_; ++a)
    for (AgentIndex b = a + 1; b < agents_; ++b) {
      const auto known = known_.find(key(a, b));
      if (known != known_.end() && known->second.excess > 0)
        statements.push_back({{a, b}, known->second.excess});
    }
}

std::size_t Dependencies::bytes() const {
  return known_.size() * (sizeof(std::uint64_t) + sizeof(Known) + 2 * sizeof(void*)) +
         known_.bucket_count() * sizeof(void*);
}

}  // namespace grove
