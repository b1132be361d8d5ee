// SPDX-License-Identifier: MIT
// What a search writes down of why its bounds hold, for a certificate (docs/proof.md).
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

// Names what a node demands: its tree, and its constraints in the order in which they were made.
// The same in every process, so what several wrote down can be put together. Two that are not the
// same have one name with a chance of 2^-64; then the certificate is refused, and nothing worse.
using ProofKey = std::uint64_t;
inline constexpr ProofKey kNoProof = 0;

ProofKey proof_key(const Tree& tree);
// O(depth).
ProofKey proof_key(const Node& node);
// Of a node of that name with one constraint more.
ProofKey proof_key(ProofKey parent, const AgentConstraint& added);

// "The one comes to rest later, or the other does": holds if these two cannot both be in time.
inline bool splits_on_costs(const Split& split) {
  return std::ranges::all_of(split, [](const AgentConstraint& demand) {
    return demand.constraint.kind == ConstraintKind::kNoRestBy;
  });
}

// There is a tree, of the joint sequences that begin so.
struct ProofTree {
  ProofKey root = kNoProof;
  Cost cost = 0;                    // of its root
  std::vector<Sequence> sequences;  // by AgentIndex: of their stops
};

// A node was split in two.
struct ProofSplit {
  ProofKey node = kNoProof;
  Split split;
  std::array<Cost, 2> costs{};  // on either side the agents' least costs add up to that, or more
  ProofKey lemma = kNoProof;    // if it splits on costs: why
};

// These agents under these demands, in canonical order for each, cost together so much or more.
struct ProofLemma {
  std::vector<AgentIndex> agents;  // ascending
  std::vector<AgentConstraint> demands;
  Cost bound = 0;

  // Of the statement; what proves it does not matter.
  ProofKey key() const;
};

// What a lemma says of the bound of a node.
struct ProofExcess {
  ProofKey lemma = kNoProof;
  std::vector<AgentIndex> agents;
  Cost excess = 0;  // these cost together so much more than each of them alone
};

// Methods may be called from any thread. What is written down need not be of use in the end, and
// may be written down again.
class ProofLog {
 public:
  ProofLog() = default;
  ProofLog(const ProofLog&) = delete;
  ProofLog& operator=(const ProofLog&) = delete;
  virtual ~ProofLog() = default;

  // Joint sequences of no such tree cost as much as the bound that the run ends with.
  virtual void tree(const ProofTree& tree) = 0;
  virtual void split(const ProofSplit& split) = 0;
  // The plans of a node cost `bound` or more, as its agents cost `cost` at least, and by what the
  // lemmas say.
  virtual void bound(ProofKey node, Cost cost, Cost bound,
                     std::span<const ProofExcess> excesses) = 0;
  // Proven by a tree of splits of which `splits` has all below `root` that are of use; or, if there
  // is none, by looking at all joint paths. The costs in them are those of the lemma's agents.
  virtual void lemma(const ProofLemma& lemma, ProofKey root,
                     std::span<const ProofSplit> splits) = 0;
  // With these rows the prices of all agents say that no plan costs less (docs/proof.md, "prices").
  virtual void prices(Cost bound, std::span<const RowMultiplier> rows) = 0;
  // Joint search of all agents says so.
  virtual void joint(Cost bound) = 0;
};

// What `group` costs together at the node that `view` has entered, when that is `excess` more than
// each of them alone.
ProofLemma lemma_at(const NodeView& view, std::span<const AgentIndex> group, Cost excess);

}  // namespace grove::detail
