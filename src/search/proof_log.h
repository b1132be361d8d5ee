// SPDX-License-Identifier: MIT
// Interface for proof logging: receives the statements by which a search proves its bounds, for a
// certificate (docs/proof.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "conflicts/conflict.h"
#include "lagrangian/relaxed_row.h"
#include "search/node_view.h"

namespace grove::detail {

// Key of the constraints of a node: a hash of its tree and of its constraints in the order in which
// they were added. It is the same in every process, so the logs of several processes can be merged.
// Two different lists of constraints have the same key with probability 2^-64; the only effect is
// that the certificate is refused.
using ProofKey = std::uint64_t;
inline constexpr ProofKey kNoProof = 0;

ProofKey proof_key(const Tree& tree);
// O(depth).
ProofKey proof_key(const Node& node);
// The key of the child that adds `added` to the node with key `parent`.
ProofKey proof_key(ProofKey parent, const AgentConstraint& added);

// True for the split "one agent comes to rest later, or the other does". Such a split is valid if
// the two agents cannot both come to rest by their given times.
inline bool splits_on_costs(const Split& split) {
  return std::ranges::all_of(split, [](const AgentConstraint& constraint) {
    return constraint.constraint.kind == ConstraintKind::kNoRestBy;
  });
}

// A tree of the forest, described by its sequences.
struct ProofTree {
  ProofKey root = kNoProof;
  Cost cost = 0;                    // of the root
  std::vector<Sequence> sequences;  // by AgentIndex
};

// The split of a node.
struct ProofSplit {
  ProofKey node = kNoProof;
  Split split;
  std::array<Cost, 2> costs{};  // lower bound on the sum of the agents' costs, by branch
  ProofKey lemma = kNoProof;    // proves a split on costs; other splits: kNoProof
};

// Statement that these agents together cost at least `bound` under these constraints: for each
// agent, first its sequence class (kStopIs, kStopIsNot), then its constraints in canonical order.
struct ProofLemma {
  std::vector<AgentIndex> agents;  // in ascending order
  std::vector<AgentConstraint> constraints;
  Cost bound = 0;

  // Key of the statement; it does not depend on the proof.
  ProofKey key() const;
};

// Use of a lemma in the proof of a node's bound.
struct ProofExcess {
  ProofKey lemma = kNoProof;
  std::vector<AgentIndex> agents;
  Cost excess = 0;  // lower bound on the excess of these agents
};

// A line of the formula of a core search (docs/proof.md, "formula").
enum class FormulaKind : std::uint8_t {
  kBegin,  // a formula begins; forgets the lines so far. No numbers
  // Prices of choices, above 0.
  kTask,  // task, price of leaving it out
  kGoal,  // place, price
  // Definitions. Those from kWithin to kCount define the variables 1, 2, ...
  kAgent,   // agent, greatest excess of its paths
  kWithin,  // agent, excess
  kActive,  // agent
  kVisit,   // agent, place, time
  kLast,    // agent, place, time
  kRests,   // agent, place, time (kNever: ever)
  kNode,   // agent, time, place, rank of the pose, stops done, task executed or -1, its steps done,
           // time of the last arrival or -1, 1 if a path with prices ends here or 0
  kMeets,  // agent and constraint: cell, from, begin, end, kind
  kCounts,  // agent, task
  kSkips,   // agent, task
  kUsed,    // place, unit of its price or 0
  kInside,  // agent, last inner place, exit, time
  kEnds,    // as kInside
  kCount,   // sum, first input, end of the inputs, least number of true inputs
  kSum,     // inputs; defines the sums 0, 1, ...
  kSplit,   // two variables
  kAtMost,  // sum, greatest number of true inputs
  // Steps.
  kClause,  // literals
  kDrop,    // number of a clause, from 0
  kCore,    // sum
};
inline constexpr auto kLastFormulaKind = FormulaKind::kCore;
inline bool is_step(FormulaKind kind) {
  return kind >= FormulaKind::kClause;
}

// Receives the statements. A statement can turn out to be unnecessary, and can be logged
// repeatedly. Thread-safe.
class ProofLog {
 public:
  ProofLog() = default;
  ProofLog(const ProofLog&) = delete;
  ProofLog& operator=(const ProofLog&) = delete;
  virtual ~ProofLog() = default;

  // Logs a tree. Joint sequences that are in no logged tree cost at least the bound with which the
  // run ends.
  virtual void tree(const ProofTree& tree) = 0;
  // Logs the split of a node.
  virtual void split(const ProofSplit& split) = 0;
  // Logs that the plans of `node` cost at least `bound`: its agents individually cost at least
  // `cost` in total, and the lemmas in `excesses` prove the rest.
  virtual void bound(ProofKey node, Cost cost, Cost bound,
                     std::span<const ProofExcess> excesses) = 0;
  // Logs a lemma that a tree of splits proves. `splits` holds all splits of this tree that are
  // needed, from the node `root` down, with the costs of the lemma's agents. If `splits` is empty,
  // the lemma is proven by enumeration of all joint paths of its agents.
  virtual void lemma(const ProofLemma& lemma, ProofKey root,
                     std::span<const ProofSplit> splits) = 0;
  // Logs that, with the multipliers `rows`, the subproblem values of all agents prove that no plan
  // costs less than `bound` (docs/proof.md, "prices").
  virtual void prices(Cost bound, std::span<const RowMultiplier> rows) = 0;
  // Logs that joint search of all agents proves that no plan costs less than `bound`.
  virtual void joint(Cost bound) = 0;
  // Logs a line of the formula of the core search.
  virtual void formula(FormulaKind kind, std::span<const std::int64_t> numbers) = 0;
  // Logs that the lines of the formula so far prove that no plan costs less than `bound`.
  virtual void formula_bound(Cost bound) = 0;
};

// The lemma that the agents `group` have an excess of at least `excess` at the node that `view` has
// entered.
ProofLemma lemma_at(const NodeView& view, std::span<const AgentIndex> group, Cost excess);

}  // namespace grove::detail
