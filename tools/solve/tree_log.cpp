// SPDX-License-Identifier: MIT
#include "tools/solve/tree_log.h"

#include "model/assert.h"

namespace grove::detail {

std::int64_t TreeLog::add(const Node& node) {
  numbers_[&node] = made_;
  return made_++;
}

std::optional<RootRow> TreeLog::root(const Node& root) {
  if (left_ == 0) return std::nullopt;
  return RootRow{add(root), root};
}

// A node has no number if it was created before the checkpoint from which this run resumed.
std::optional<NodeRow> TreeLog::expanded(const Node& node, const Expansion& expansion, int worker) {
  if (left_ == 0) return std::nullopt;
  const auto known = numbers_.find(&node);
  if (known == numbers_.end()) return std::nullopt;
  NodeRow row{known->second, worker, node, expansion};
  numbers_.erase(known);
  for (std::size_t i = 0; i < expansion.children.size(); ++i)
    row.children[i] = add(*expansion.children[i]);
  for (std::size_t i = 0; i < expansion.children.size(); ++i)
    GROVE_CHECK(row.children[i] > row.number, "a child has a larger number than its parent");
  if (--left_ == 0) numbers_.clear();
  return row;
}

}  // namespace grove::detail
