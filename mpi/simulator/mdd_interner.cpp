// SPDX-License-Identifier: MIT
#include "mpi/simulator/mdd_interner.h"

namespace grove::detail {

MddCache::Set MddInterner::one_of(const MddCache::Set& set) {
  const std::uint64_t hash = set->hash();
  const auto [first, end] = sets_.equal_range(hash);
  for (auto at = first; at != end; ++at)
    if (auto other = at->second.lock(); other && *other == *set) return other;
  if (sets_.size() >= many_) forget_unused();
  sets_.emplace(hash, set);
  return set;
}

void MddInterner::forget_unused() {
  std::erase_if(sets_, [](const auto& entry) { return entry.second.expired(); });
  many_ = 2 * sets_.size() + 1000;
}

}  // namespace grove::detail
