// SPDX-License-Identifier: MIT
// A table in parts with a lock each.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "model/assert.h"

namespace grove::detail {

// Parts of one kind that threads use side by side; what belongs to one key is in one part, and so
// many threads rarely meet. A part is held for as long as it takes to look something up.
template <class Part>
class Sharded {
 public:
  static constexpr unsigned kBits = 5;
  static constexpr std::size_t kParts = std::size_t{1} << kBits;

  // Of a key that is not negative.
  static constexpr std::size_t part_of(std::integral auto key) {
    GROVE_ASSERT(key >= 0, "keys are not negative");
    return static_cast<std::size_t>(key) % kParts;
  }

  // Calls use(part) under the lock of the part `number` < kParts and returns what it returns.
  template <class Use>
  decltype(auto) with(std::size_t number, Use use) const {
    const Locked& locked = parts_[number];
    const std::lock_guard lock(locked.mutex);
    return use(locked.part);
  }
  template <class Use>
  decltype(auto) with(std::size_t number, Use use) {
    Locked& locked = parts_[number];
    const std::lock_guard lock(locked.mutex);
    return use(locked.part);
  }

 private:
  struct alignas(64) Locked {  // a cache line: neighbours do not disturb each other
    mutable std::mutex mutex;
    Part part;
  };
  std::array<Locked, kParts> parts_;
};

}  // namespace grove::detail
