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
};

// The lemma that the agents `group` have an excess of at least `excess` at the node that `view` has
// entered.
ProofLemma lemma_at(const NodeView& view, std::span<const AgentIndex> group, Cost excess);

}  // namespace grove::detail
