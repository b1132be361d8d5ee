// SPDX-License-Identifier: MIT
// Interface for proof logging: the statements of a search that prove its bounds, for a certificate
// (docs/proof.md).
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

// Key of the constraints of a node: hash of its tree and of its constraints in the order in which
// they were added. It is the same in every process, so the logs of several processes can be merged.
// Two different nodes have the same key with probability 2^-64; the certificate is then refused,
// with no other effect.
using ProofKey = std::uint64_t;
inline constexpr ProofKey kNoProof = 0;

ProofKey proof_key(const Tree& tree);
// O(depth).
ProofKey proof_key(const Node& node);
// The key of a child of the node with key `parent`.
ProofKey proof_key(ProofKey parent, const AgentConstraint& added);

// True for the split "one agent comes to rest later, or the other does". It is valid if these two
// cannot both arrive in time.
inline bool splits_on_costs(const Split& split) {
  return std::ranges::all_of(split, [](const AgentConstraint& constraint) {
    return constraint.constraint.kind == ConstraintKind::kNoRestBy;
  });
}

// A tree of the forest, by its sequences.
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
  ProofKey lemma = kNoProof;    // proves a split on costs; else kNoProof
};

// Statement: these agents under these constraints, in canonical order for each agent, cost together
// at least `bound`.
struct ProofLemma {
  std::vector<AgentIndex> agents;  // in ascending order
  std::vector<AgentConstraint> constraints;
  Cost bound = 0;

  // Key of the statement, whatever its proof.
  ProofKey key() const;
};

// Use of a lemma for the bound of a node.
struct ProofExcess {
  ProofKey lemma = kNoProof;
  std::vector<AgentIndex> agents;
  Cost excess = 0;  // of these agents together, at least
};

// Sink of the statements. Thread-safe. A statement may be useless in the end, and may be logged
// repeatedly.
class ProofLog {
 public:
  ProofLog() = default;
  ProofLog(const ProofLog&) = delete;
  ProofLog& operator=(const ProofLog&) = delete;
  virtual ~ProofLog() = default;

  // Joint sequences that are in no logged tree cost at least the bound with which the run ends.
  virtual void tree(const ProofTree& tree) = 0;
  virtual void split(const ProofSplit& split) = 0;
  // The plans of a node cost at least `bound`: its agents cost at least `cost`, and the lemmas in
  // `excesses` prove the rest.
  virtual void bound(ProofKey node, Cost cost, Cost bound,
                     std::span<const ProofExcess> excesses) = 0;
  // A lemma proven by a tree of splits; `splits` holds all needed ones below `root`, with the costs
  // of the lemma's agents. If `splits` is empty, the lemma is proven by enumeration of all joint
  // paths.
  virtual void lemma(const ProofLemma& lemma, ProofKey root,
                     std::span<const ProofSplit> splits) = 0;
  // With the multipliers `rows`, the subproblem values of all agents prove that no plan costs less
  // than `bound` (docs/proof.md, "prices").
  virtual void prices(Cost bound, std::span<const RowMultiplier> rows) = 0;
  // Joint search of all agents proves that no plan costs less than `bound`.
  virtual void joint(Cost bound) = 0;
};

// The lemma that the agents `group` have an excess of at least `excess` at the node that `view` has
// entered.
ProofLemma lemma_at(const NodeView& view, std::span<const AgentIndex> group, Cost excess);

}  // namespace grove::detail
