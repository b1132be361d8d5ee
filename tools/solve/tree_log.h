// SPDX-License-Identifier: MIT
// Numbers and selects the first nodes of a run's constraint trees, for --log-tree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "search/expander.h"
#include "search/node.h"

namespace grove::detail {

// The root of a tree.
struct RootRow {
  std::int64_t number = 0;  // number of the root node
  const Node& root;
};

// An expanded node and its children.
struct NodeRow {
  std::int64_t number = 0;
  int worker = 0;
  const Node& node;
  const Expansion& expansion;
  std::array<std::int64_t, 2> children{};  // numbers of the children, in the order of `expansion`
};

// Numbers nodes from 0 in order of creation until `max_expanded` nodes have been expanded. Owns no
// nodes and identifies them by address; a reused address refers to the node that was created last.
class TreeLog {
 public:
  explicit TreeLog(std::int64_t max_expanded) : left_(max_expanded) {}

  // Return the row to log. Return nullopt if `max_expanded` nodes have been expanded, or if the
  // expanded node has no number.
  std::optional<RootRow> root(const Node& root);
  std::optional<NodeRow> expanded(const Node& node, const Expansion& expansion, int worker);

 private:
  std::int64_t add(const Node& node);

  std::int64_t left_;  // expansions to log
  std::int64_t made_ = 0;
  std::unordered_map<const Node*, std::int64_t> numbers_;  // nodes that are not yet expanded
};

}  // namespace grove::detail
