// SPDX-License-Identifier: MIT
// Constraints that are active at a line of a proof; the lines above it determine them
// (docs/proof.md, section 4).
#pragma once

#include <cstdint>
#include <unordered_map>

#include "proof/certificate_reader.h"

namespace grove::detail {

// A side of "later" is a `norest` constraint on the goal of its agent. A certificate does not state
// this goal, so constraint_of() gives the constraint the place kSomeGoal.
inline constexpr std::int32_t kSomeGoal = -1;
CertificateConstraint constraint_of(const CertificateLate& side);

class ActiveConstraints {
 public:
  // Adds a constraint of a lemma.
  void add(const CertificateConstraint& constraint) { ++counts_[constraint]; }
  // Adds a side of a split, including the constraints that it implies for other agents; undo()
  // removes it again.
  void assume(const CertificateConstraint& side) { count(side, 1); }
  void undo(const CertificateConstraint& side) { count(side, -1); }
  void clear() { counts_.clear(); }

  // True if `constraint` is active. Does not report a constraint that is active only through a side
  // of "later", because the goal in such a side is not known.
  bool has(const CertificateConstraint& constraint) const;
  // True if `side` is known to add no constraint to the active ones.
  bool has_side(const CertificateConstraint& side) const;
  // True if `constraint` is one of the constraints that `side` adds. *this must hold the
  // constraints that are active without `side`. The result is correct only for valid proofs.
  bool is_of(const CertificateConstraint& constraint, const CertificateConstraint& side) const;

 private:
  struct Hash {
    std::size_t operator()(const CertificateConstraint& constraint) const;
  };

  void count(const CertificateConstraint& side, int more);
  void count_one(const CertificateConstraint& constraint, int more);
  int times(const CertificateConstraint& constraint) const;

  std::unordered_map<CertificateConstraint, int, Hash> counts_;
};

}  // namespace grove::detail
