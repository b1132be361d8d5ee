// SPDX-License-Identifier: MIT
// The constraint trees of all joint sequences, combined into one proof. Its upper part splits on
// the next stops of the agents. Below these splits are the trees, each down to the nodes at which
// the bound is proven.
#pragma once

#include <cstddef>
#include <vector>

#include "conflicts/conflict.h"
#include "proof/proof_records.h"
#include "proof/split_tree.h"

namespace grove::detail {

// Callbacks for each leaf and split, in the order of the certificate.
class ForestVisitor {
 public:
  virtual ~ForestVisitor() = default;
  // nullptr: the individual costs of the agents suffice.
  virtual void leaf(ProofEntry* entry) = 0;
  virtual void split(const ProofEntry& entry) = 0;
  virtual void split(const Split& on_sequence) = 0;
};

class ProofForest {
 public:
  // `records` must outlive this object. One thread at a time.
  explicit ProofForest(ProofRecords& records) : records_(records), tree_(records.entries) {}

  // Returns the bound that the trees prove, at most `claimed`. Call it before visit().
  Cost value(Cost claimed);
  // Visits the proof of `bound`, which must be at most value().
  void visit(Cost bound, ForestVisitor& visitor);

 private:
  using Trees = std::vector<const ProofTree*>;

  void visit(const Trees& trees, std::size_t agent, std::size_t number, ForestVisitor& visitor);
  void visit(const ProofTree& tree, ForestVisitor& visitor);

  ProofRecords& records_;
  SplitTree tree_;
  Cost bound_ = 0;
};

}  // namespace grove::detail
