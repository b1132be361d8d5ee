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
CertificateDemand demand_of(const CertificateLate& side);

class ActiveConstraints {
 public:
  // Adds a constraint of a lemma.
  void add(const CertificateDemand& demand) { ++counts_[demand]; }
  // Adds a side of a split, with the constraints that it implies for other agents.
  void assume(const CertificateDemand& side) { count(side, 1); }
  void undo(const CertificateDemand& side) { count(side, -1); }
  void clear() { counts_.clear(); }

  // Whether `demand` is active. If it returns false, a side of "later" may still impose it.
  bool has(const CertificateDemand& demand) const;
  // Whether `side` would add no constraint.
  bool has_side(const CertificateDemand& side) const;
  // Whether `side` imposes `demand`, if *this holds the constraints that are active without the
  // side. For valid proofs only.
  bool is_of(const CertificateDemand& demand, const CertificateDemand& side) const;

 private:
  struct Hash {
    std::size_t operator()(const CertificateDemand& demand) const;
  };

  void count(const CertificateDemand& side, int more);
  void count_one(const CertificateDemand& demand, int more);
  int times(const CertificateDemand& demand) const;

  std::unordered_map<CertificateDemand, int, Hash> counts_;
};

}  // namespace grove::detail
