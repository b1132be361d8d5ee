// SPDX-License-Identifier: MIT
// Finds entries of a list by what they are. For tables with millions of small entries: 11 to 21
// bytes for each beside the entry itself, no allocation of its own, and mostly one line of the
// cache to learn that there is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grove::detail {

// Numbers of entries by their hashes: open addressing, at most three quarters full. What the
// entries are the user knows, and keeps in the order of their numbers; nothing is ever removed. Of
// one thread at a time.
class HashIndex {
 public:
  using Number = std::int32_t;
  static constexpr Number kNone = -1;

  // The entry with this hash of which `is_it` says that it is the one; kNone. All bits of `hash`
  // must be good.
  template <class IsIt>
  Number find(std::uint32_t hash, IsIt is_it) const {
    if (slots_.empty()) return kNone;
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash & mask; slots_[at].number != kNone; at = (at + 1) & mask)
      if (slots_[at].hash == hash && is_it(slots_[at].number)) return slots_[at].number;
    return kNone;
  }

  // Makes room for one more. Throws std::bad_alloc; add() then does not.
  void reserve_one();
  // An entry that is not there yet: its number is size() before.
  Number add(std::uint32_t hash);

  Number size() const { return size_; }
  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    std::uint32_t hash = 0;
    Number number = kNone;
  };

  void put(Slot slot);

  std::vector<Slot> slots_;  // a power of two
  Number size_ = 0;
};

}  // namespace grove::detail
