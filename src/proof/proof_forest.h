// SPDX-License-Identifier: MIT
// The trees of all joint sequences as one proof: splits by what the next stops are, and below them
// each tree, as far down as the bound asks for.
#pragma once

#include <cstddef>
#include <vector>

#include "conflicts/conflict.h"
#include "proof/proof_records.h"
#include "proof/split_tree.h"

namespace grove::detail {

// What is done with it, leaf by leaf and split by split, in the order of the certificate.
class ForestVisitor {
 public:
  virtual ~ForestVisitor() = default;
  // Null: the agents' own costs are enough.
  virtual void leaf(ProofEntry* entry) = 0;
  virtual void split(const ProofEntry& entry) = 0;
  virtual void split(const Split& on_sequence) = 0;
};

class ProofForest {
 public:
  // `written` must outlive this.
  explicit ProofForest(ProofRecords& written) : written_(written), tree_(written.entries) {}

  // What it proves, up to `claimed`.
  Cost value(Cost claimed);
  void visit(Cost bound, ForestVisitor& visitor);

 private:
  using Trees = std::vector<const ProofTree*>;

  void visit(const Trees& trees, std::size_t agent, std::size_t number, ForestVisitor& visitor);
  void visit(const ProofTree& tree, ForestVisitor& visitor);

  ProofRecords& written_;
  SplitTree tree_;
  Cost bound_ = 0;
};

}  // namespace grove::detail
