// SPDX-License-Identifier: MIT
// Hash map from sets of stops to numbers, for sequence graphs.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/assert.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Uses open addressing with linear probing. One thread at a time.
class StopSetIndex {
 public:
  static constexpr std::uint32_t kAbsent = UINT32_MAX;

  StopSetIndex() : slots_(16) {}
  std::uint32_t find(StopSet set) const { return slots_[slot_of(set)].number; }
  std::size_t bytes() const { return slots_.size() * sizeof(Slot); }
  // Returns the number of `set`. If the set has no number, assigns `number` to it first.
  std::uint32_t insert(StopSet set, std::uint32_t number);

 private:
  struct Slot {
    StopSet set = 0;
    std::uint32_t number = kAbsent;
  };

  std::size_t slot_of(StopSet set) const;
  void grow();

  std::vector<Slot> slots_;  // size: a power of two; at most half full
  std::size_t used_ = 0;
};

inline std::size_t StopSetIndex::slot_of(StopSet set) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = (set * 0x9E3779B97F4A7C15u) >> (65 - std::bit_width(slots_.size()));
  while (slots_[slot].number != kAbsent && slots_[slot].set != set) slot = (slot + 1) & mask;
  return slot;
}

inline std::uint32_t StopSetIndex::insert(StopSet set, std::uint32_t number) {
  Slot& slot = slots_[slot_of(set)];
  if (slot.number != kAbsent) return slot.number;
  GROVE_ASSERT(number != kAbsent, "a number differs from the mark of an absent set");
  slot = {set, number};
  if (2 * ++used_ > slots_.size()) grow();
  GROVE_ASSERT(find(set) == number && 2 * used_ <= slots_.size(),
               "a set is found under its number, and at least half of the slots are free");
  return number;
}

inline void StopSetIndex::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.number != kAbsent) slots_[slot_of(slot.set)] = slot;
}

}  // namespace grove::detail
