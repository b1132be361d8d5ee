// SPDX-License-Identifier: MIT
// Table divided into parts with one lock each.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "model/assert.h"

namespace grove::detail {

// Table that threads use concurrently. It is divided by key into kParts parts, each with its own
// lock, so that threads rarely contend. All data of one key is in one part. A lock is held for one
// lookup or update. Thread-safe.
template <class Part>
class Sharded {
 public:
  static constexpr unsigned kBits = 5;
  static constexpr std::size_t kParts = std::size_t{1} << kBits;

  // The number of the part that holds `key`, which must not be negative.
  static constexpr std::size_t part_of(std::integral auto key) {
    GROVE_ASSERT(key >= 0, "keys are not negative");
    return static_cast<std::size_t>(key) % kParts;
  }

  // Calls use(part) under the lock of part `number` < kParts and returns its result.
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
  struct alignas(64) Locked {  // a cache line: avoids false sharing
    mutable std::mutex mutex;
    Part part;
  };
  std::array<Locked, kParts> parts_;
};

}  // namespace grove::detail
