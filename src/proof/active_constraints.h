// SPDX-License-Identifier: MIT
// Constraints that are active at a place in a proof, given by the lines above it (docs/proof.md,
// section 4).
#pragma once

#include <cstdint>
#include <unordered_map>

#include "proof/certificate_reader.h"

namespace grove::detail {

// A side of "later" forbids its agent to rest on its goal, which only the instance contains. Here
// that constraint has the place kSomeGoal.
inline constexpr std::int32_t kSomeGoal = -1;
CertificateConstraint constraint_of(const CertificateLate& side);

class ActiveConstraints {
 public:
  // Adds a constraint of a lemma.
  void add(const CertificateConstraint& constraint) { ++counts_[constraint]; }
  // Adds a side of a split, with the constraints that it implies for other agents.
  void assume(const CertificateConstraint& side) { count(side, 1); }
  void undo(const CertificateConstraint& side) { count(side, -1); }
  void clear() { counts_.clear(); }

  // Whether `constraint` is active. If it returns false, a side of "later" may still impose it.
  bool has(const CertificateConstraint& constraint) const;
  // Whether `side` would add no constraint.
  bool has_side(const CertificateConstraint& side) const;
  // Whether `side` imposes `constraint`, if *this holds the constraints that are active without the
  // side. For valid proofs only.
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
