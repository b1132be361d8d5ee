// SPDX-License-Identifier: MIT
// Sets of optimal paths that many simulated ranks made, each once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "search/mdd_cache.h"

namespace grove::detail {

// Each rank makes the sets that it needs for itself, and most need the same. What is equal need not
// be in memory twice: two fifths of what 128 ranks hold otherwise on room-32-32-4 22/40, a quarter
// of what 1,024 do. Of one thread.
class MddInterner {
 public:
  // One that is equal, if it is still in use; this one otherwise.
  MddCache::Set one_of(const MddCache::Set& set);

  std::size_t size() const { return sets_.size(); }

 private:
  void forget_unused();

  std::unordered_multimap<std::uint64_t, std::weak_ptr<const Mdd>> sets_;  // by hash
  std::size_t many_ = 1000;
};

}  // namespace grove::detail
