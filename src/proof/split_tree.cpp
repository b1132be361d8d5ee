// SPDX-License-Identifier: MIT
#include "proof/split_tree.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {

Cost SplitTree::value(ProofKey root, Cost cost) {
  struct Step {
    ProofKey node;
    Cost cost;
    bool again;
  };
  std::vector<Step> steps{{root, cost, false}};
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    const auto found = entries_.find(step.node);
    if (found == entries_.end() || found->second.value) continue;
    ProofEntry& entry = found->second;
    entry.cost = std::max(entry.cost, step.cost);
    if (entry.split && !step.again) {
      steps.push_back({step.node, step.cost, true});
      const auto sides = sides_of(*entry.split);
      for (int i = 0; i < 2; ++i) steps.push_back({sides[i], entry.split->costs[i], false});
      continue;
    }
    GROVE_ASSERT(!entry.split || std::ranges::all_of(sides_of(*entry.split),
                                                     [&](ProofKey side) {
                                                       const auto it = entries_.find(side);
                                                       return it == entries_.end() ||
                                                              it->second.value.has_value();
                                                     }),
                 "both sides of a split have their values before the node");
    entry.value = std::max({entry.cost, entry.bound, entry.split ? of_sides(entry) : 0});
  }
  return value_of(root, cost);
}

std::array<ProofKey, 2> SplitTree::sides_of(const ProofSplit& split) {
  return {proof_key(split.node, split.split[0]), proof_key(split.node, split.split[1])};
}

Cost SplitTree::of_sides(const ProofEntry& entry) const {
  const auto sides = sides_of(*entry.split);
  return std::min(value_of(sides[0], entry.split->costs[0]),
                  value_of(sides[1], entry.split->costs[1]));
}

Cost SplitTree::value_of(ProofKey node, Cost cost) const {
  const auto found = entries_.find(node);
  if (found == entries_.end() || !found->second.value) return cost;
  return std::max(cost, *found->second.value);
}

}  // namespace grove::detail
