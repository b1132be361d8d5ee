// SPDX-License-Identifier: MIT
// Where those who expand nodes get trees from.
#pragma once

namespace grove::detail {

// Brings trees when they are due. This one never does, for trees are not this process's business;
// the one that does is CentralTrees. Methods may be called from any thread and do not wait.
class TreeSource {
 public:
  TreeSource() = default;
  TreeSource(const TreeSource&) = delete;
  TreeSource& operator=(const TreeSource&) = delete;
  virtual ~TreeSource() = default;

  // Before a node is taken: brings the next tree where Algorithm 4 finds that necessary.
  virtual void instantiate_due_tree() {}
  // No node is live here: brings nodes or finds that there are none.
  virtual void refill_nodes() {}
  // May the caller prepare the next tree before Algorithm 4 asks for it? Whoever is told so must do
  // it. One at a time.
  virtual bool claim_preparation() { return false; }
  virtual void prepare_tree() {}
};

}  // namespace grove::detail
