// SPDX-License-Identifier: MIT
#include "proof/proof_forest.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {

Cost ProofForest::value(Cost claimed) {
  Cost value = claimed;
  for (const ProofTree& tree : records_.trees)
    value = std::min(value, tree_.value(tree.root, tree.cost));
  return value;
}

void ProofForest::visit(Cost bound, ForestVisitor& visitor) {
  bound_ = bound;
  Trees all;
  for (const ProofTree& tree : records_.trees) all.push_back(&tree);
  visit(all, 0, 0, visitor);
}

// Visits the proof for `trees`, which agree on all stops before stop `number` of `agent`. Splits on
// whether this stop is that of the first tree, and continues stop by stop until all stops are fixed
// or no tree is left. If `trees` is empty, the individual costs of the agents suffice, as for all
// joint sequences without a tree.
void ProofForest::visit(const Trees& trees, std::size_t agent, std::size_t number,
                        ForestVisitor& visitor) {
  if (trees.empty()) return visitor.leaf(nullptr);
  const std::vector<Sequence>& sequences = trees.front()->sequences;
  while (agent < sequences.size() && number == sequences[agent].size()) {
    ++agent;
    number = 0;
  }
  GROVE_ASSERT(std::ranges::all_of(trees,
                                   [&](const ProofTree* tree) {
                                     return std::equal(tree->sequences.begin(),
                                                       tree->sequences.begin() +
                                                           static_cast<std::ptrdiff_t>(agent),
                                                       sequences.begin());
                                   }),
               "the trees of a subproof agree on the agents before");
  if (agent == sequences.size()) {
    GROVE_CHECK(trees.size() == 1, "no two trees have the same joint sequence");
    return visit(*trees.front(), visitor);
  }
  const Stop stop = sequences[agent][number];
  const auto constraint = [&](ConstraintKind kind) {
    const auto at = static_cast<Time>(number);
    return AgentConstraint{static_cast<AgentIndex>(agent), {kNoPlace, stop, at, at, kind}};
  };
  visitor.split({constraint(ConstraintKind::kStopIs), constraint(ConstraintKind::kStopIsNot)});
  Trees of_it;
  Trees others;
  for (const ProofTree* tree : trees)
    (tree->sequences[agent][number] == stop ? of_it : others).push_back(tree);
  visit(of_it, agent, number + 1, visitor);
  visit(others, agent, number, visitor);
}

void ProofForest::visit(const ProofTree& tree, ForestVisitor& visitor) {
  tree_.walk(
      tree.root, tree.cost, bound_, [&](ProofEntry* entry) { visitor.leaf(entry); },
      [&](const ProofEntry& entry) { visitor.split(entry); });
}

}  // namespace grove::detail
