// SPDX-License-Identifier: MIT
// What is demanded at a place in a proof, as the lines above it tell (docs/proof.md, section 4).
#pragma once

#include <cstdint>
#include <unordered_map>

#include "proof/certificate_reader.h"

namespace grove::detail {

// A side of "later" demands a rest on a goal that only the instance knows: here on no place.
inline constexpr std::int32_t kSomeGoal = -1;
CertificateDemand demand_of(const CertificateLate& side);

class ActiveConstraints {
 public:
  // Of a lemma.
  void add(const CertificateDemand& demand) { ++counts_[demand]; }
  // A side of a split, with what it brings for other agents.
  void assume(const CertificateDemand& side) { count(side, 1); }
  void undo(const CertificateDemand& side) { count(side, -1); }
  void clear() { counts_.clear(); }

  // If not, it may still be demanded by a side of "later".
  bool has(const CertificateDemand& demand) const;
  // Nothing more would be demanded with this side.
  bool has_side(const CertificateDemand& side) const;
  // Does this side demand it, where these are in force without the side? Of a proof that holds.
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
