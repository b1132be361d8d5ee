// SPDX-License-Identifier: MIT
// The first nodes of a run's constraint trees, for --log-tree.
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
  std::int64_t number = 0;  // number of the node
  const Node& root;
};

// An expanded node and its children.
struct NodeRow {
  std::int64_t number = 0;
  int worker = 0;
  const Node& node;
  const Expansion& expansion;
  std::array<std::int64_t, 2> children{};  // numbers of the children
};

// Numbers nodes from 0 in order of creation, until `max_expanded` nodes were expanded. Owns no
// node: if an address is reused, it belongs to the node created last.
class TreeLog {
 public:
  explicit TreeLog(std::int64_t max_expanded) : left_(max_expanded) {}

  // Return nullopt if the node is not to be logged.
  std::optional<RootRow> root(const Node& root);
  std::optional<NodeRow> expanded(const Node& node, const Expansion& expansion, int worker);

 private:
  std::int64_t add(const Node& node);

  std::int64_t left_;  // expansions to log
  std::int64_t made_ = 0;
  std::unordered_map<const Node*, std::int64_t> numbers_;  // of nodes not expanded yet
};

}  // namespace grove::detail
