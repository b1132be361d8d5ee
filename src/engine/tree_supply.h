// SPDX-License-Identifier: MIT
// Interface through which workers get the trees of a run.
#pragma once

namespace grove::detail {

// Supplies trees when they are due. CentralTrees implements it in the process that owns the trees;
// this base class, for other processes, supplies none. Thread-safe. No function waits for another
// thread: while one thread supplies a tree, the calls of other threads do nothing.
class TreeSupply {
 public:
  TreeSupply() = default;
  TreeSupply(const TreeSupply&) = delete;
  TreeSupply& operator=(const TreeSupply&) = delete;
  virtual ~TreeSupply() = default;

  // Instantiates the next tree if Algorithm 4 of the paper requires it. Must be called before a
  // node is taken.
  virtual void instantiate_due_tree() {}
  // Supplies nodes, or ends the run if there are none. Must be called only if no node is live here.
  virtual void refill_nodes() {}
  // Returns true if the caller may prepare the next tree before Algorithm 4 of the paper requires
  // it; the caller must then call prepare_tree(). Only one caller at a time gets true.
  virtual bool claim_preparation() { return false; }
  virtual void prepare_tree() {}
};

}  // namespace grove::detail
