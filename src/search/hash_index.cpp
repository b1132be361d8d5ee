// SPDX-License-Identifier: MIT
#include "search/hash_index.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kFirstSize = 64;

}  // namespace

void HashIndex::reserve_one() {
  if (4 * (static_cast<std::size_t>(size_) + 1) <= 3 * slots_.size()) return;
  std::vector<Slot> smaller(std::max(kFirstSize, 2 * slots_.size()));
  smaller.swap(slots_);
  for (const Slot& slot : smaller)
    if (slot.number != kNone) put(slot);
  GROVE_ASSERT(4 * (static_cast<std::size_t>(size_) + 1) <= 3 * slots_.size(),
               "an index is at most three quarters full");
}

HashIndex::Number HashIndex::add(std::uint32_t hash) {
  GROVE_ASSERT(static_cast<std::size_t>(size_) < slots_.size(),
               "reserve_one() is called before add()");
  put({hash, size_});
  GROVE_ASSERT(find(hash, [&](Number number) { return number == size_; }) == size_,
               "an entry that was added is found");
  return size_++;
}

void HashIndex::put(Slot slot) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = slot.hash & mask;
  while (slots_[at].number != kNone) at = (at + 1) & mask;
  slots_[at] = slot;
}

}  // namespace grove::detail
