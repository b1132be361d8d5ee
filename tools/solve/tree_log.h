// SPDX-License-Identifier: MIT
// The first nodes of a run's constraint trees, for its log.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "search/expander.h"
#include "search/node.h"

namespace grove::detail {

// A root, made by the run.
struct RootRow {
  std::int64_t number = 0;  // of the node
  const Node& root;
};

// A node that was expanded, and what it led to.
struct NodeRow {
  std::int64_t number = 0;
  int worker = 0;
  const Node& node;
  const Expansion& expansion;
  std::array<std::int64_t, 2> children{};  // their numbers
};

// Numbers nodes from 0 in the order in which they are made, until so many have been expanded. It
// holds none of them: an address that a dead one had is that of the last node made there.
class TreeLog {
 public:
  explicit TreeLog(std::int64_t most_expanded) : left_(most_expanded) {}

  // None: it is not to be logged.
  std::optional<RootRow> root(const Node& root);
  std::optional<NodeRow> expanded(const Node& node, const Expansion& expansion, int worker);

 private:
  std::int64_t add(const Node& node);

  std::int64_t left_;  // expansions to log
  std::int64_t made_ = 0;
  std::unordered_map<const Node*, std::int64_t> numbers_;  // of nodes not expanded yet
};

}  // namespace grove::detail
