// SPDX-License-Identifier: MIT
// A logged tree of splits, from its root down to the nodes at which the bound is proven. The code
// uses no recursion, because the depth of a tree can be as large as its number of nodes.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "proof/proof_records.h"

namespace grove::detail {

class SplitTree {
 public:
  // `entries` must outlive this object. value() stores in them the bounds that the nodes prove. One
  // thread at a time.
  explicit SplitTree(ProofEntries& entries) : entries_(entries) {}

  // Returns the bound that the tree at `root` proves, where `cost` is the sum of the individual
  // costs of the agents at the root.
  Cost value(ProofKey root, Cost cost);

  // Calls leaf(entry or nullptr) and split(entry) for the proof of `bound`, in the order of the
  // certificate. nullptr: the individual costs of the agents suffice. Call value() first.
  template <class Leaf, class Split>
  void walk(ProofKey root, Cost cost, Cost bound, Leaf leaf, Split split) {
    std::vector<std::pair<ProofKey, Cost>> left{{root, cost}};
    while (!left.empty()) {
      const auto [node, cost_there] = left.back();
      left.pop_back();
      const auto found = entries_.find(node);
      ProofEntry* const entry = found == entries_.end() ? nullptr : &found->second;
      if (entry == nullptr || std::max(entry->cost, cost_there) >= bound) {
        leaf(nullptr);
      } else if (entry->bound >= bound) {
        leaf(entry);
      } else if (entry->split && of_sides(*entry) >= bound) {
        split(*entry);
        const auto sides = sides_of(*entry->split);
        for (const int i : {1, 0}) left.emplace_back(sides[i], entry->split->costs[i]);
      } else {
        leaf(entry);
      }
    }
  }

 private:
  static std::array<ProofKey, 2> sides_of(const ProofSplit& split);
  Cost of_sides(const ProofEntry& entry) const;
  Cost value_of(ProofKey node, Cost cost) const;

  ProofEntries& entries_;
};

}  // namespace grove::detail
