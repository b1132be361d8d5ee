// SPDX-License-Identifier: MIT
// Hash index: finds the entries of a list by their content. It is made for tables with millions of
// small entries: it takes 11 to 21 bytes per entry in addition to the entry itself, allocates
// nothing per entry, and mostly reads one cache line in an unsuccessful search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grove::detail {

// Maps hashes to numbers of entries: open addressing, at most three quarters full. The caller
// stores the entries in the order of their numbers. Entries are never removed. One thread at a
// time.
class HashIndex {
 public:
  using Number = std::int32_t;
  static constexpr Number kNone = -1;

  // Returns the number of the entry with this hash for which matches(number) holds, or kNone. All
  // bits of `hash` must be well mixed.
  template <class Matches>
  Number find(std::uint32_t hash, Matches matches) const {
    if (slots_.empty()) return kNone;
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash & mask; slots_[at].number != kNone; at = (at + 1) & mask)
      if (slots_[at].hash == hash && matches(slots_[at].number)) return slots_[at].number;
    return kNone;
  }

  // Reserves space for one more entry, so that the next add() does not throw. May itself throw
  // std::bad_alloc.
  void reserve_one();
  // Adds an entry that is not in the index and returns its number, which is size() before the call.
  // Call reserve_one() first.
  Number add(std::uint32_t hash);

  Number size() const { return size_; }
  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    std::uint32_t hash = 0;
    Number number = kNone;
  };

  void put(Slot slot);

  std::vector<Slot> slots_;  // size: a power of two, or 0
  Number size_ = 0;
};

}  // namespace grove::detail
