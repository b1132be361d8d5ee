// SPDX-License-Identifier: MIT
// Interface through which workers request trees.
#pragma once

namespace grove::detail {

// Supplies trees when they are due. This base class never does, for processes that do not own the
// trees; CentralTrees does. Thread-safe; no method waits.
class TreeSource {
 public:
  TreeSource() = default;
  TreeSource(const TreeSource&) = delete;
  TreeSource& operator=(const TreeSource&) = delete;
  virtual ~TreeSource() = default;

  // Call before taking a node: instantiates the next tree if Algorithm 4 requires it.
  virtual void instantiate_due_tree() {}
  // Call if no node is live here: supplies nodes or finds that there are none.
  virtual void refill_nodes() {}
  // Returns true if the caller may prepare the next tree before Algorithm 4 requires it. The caller
  // must then call prepare_tree(). One caller at a time gets true.
  virtual bool claim_preparation() { return false; }
  virtual void prepare_tree() {}
};

}  // namespace grove::detail
