// SPDX-License-Identifier: MIT
// Arrays in memory that several processes share. The processes compute them together, and each
// process reads all of them. This file defines which arrays there are, where they lie, and which
// process computes which.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/limits.h"

namespace grove::detail {

// The content of an array, and the meaning of its number.
enum class ArrayKind : std::uint8_t {
  kDistances,      // 16-bit distances (DistanceFields); number: set of states
  kStopsOfStates,  // the stop at each state (AgentStops); number: agent
  kSequenceTable,  // costs to go (CostToGo); number: agent
};
inline constexpr int kArrayKinds = 3;

// The size of each array in bytes, by kind and number; 0: there is no such array.
using ArrayLayout = std::array<std::vector<std::size_t>, kArrayKinds>;

class SharedArrays;

// One shared array, or none. Refers to the memory of its SharedArrays. Thread-safe.
class SharedArray {
 public:
  SharedArray() = default;  // none

  // True if there is an array with room for `bytes` bytes.
  bool has_room(std::size_t bytes) const { return bytes <= room_; }

  // Computes the array unless another process or thread has begun to. Calls fill(begin), where
  // `begin` points to the memory of the array, of the size in the layout. fill() returns true if it
  // succeeded. It must write the same bytes in all processes.
  template <class Fill>
  void make(const Fill& fill) const;

  // Returns the complete array. While another process or thread computes it, waits up to 1 s.
  // Returns nullptr if the array could not be computed, no process has begun to compute it, the
  // process that did is unresponsive, or `limits` is reached. Then the caller must compute an array
  // of its own.
  const std::byte* await(const Limits& limits) const;

  // make(), then await().
  template <class Fill>
  const std::byte* get(const Limits& limits, const Fill& fill) const {
    make(fill);
    return await(limits);
  }

 private:
  friend class SharedArrays;
  // The phase of an array, in shared memory.
  enum Progress : std::uint32_t { kEmpty, kClaimed, kReady, kFailed };
  using Flag = std::atomic<std::uint32_t>;
  static_assert(Flag::is_always_lock_free, "else it would be of one process alone");

  SharedArray(Flag* flag, std::byte* begin, std::size_t room)
      : flag_(flag), begin_(begin), room_(room) {}
  bool claim() const;
  // Stores the result when it is destroyed, also after an exception, so that other processes see
  // it.
  class Claimed {
   public:
    explicit Claimed(Flag& flag) : flag_(flag) {}
    ~Claimed() { flag_.store(result, std::memory_order_release); }
    Claimed(const Claimed&) = delete;
    Claimed& operator=(const Claimed&) = delete;
    Progress result = kFailed;

   private:
    Flag& flag_;
  };

  Flag* flag_ = nullptr;
  std::byte* begin_ = nullptr;
  std::size_t room_ = 0;
};

// All arrays of a layout, in memory that the caller owns. Any number of processes, the *members*,
// may have mapped this memory. All members compute the same data from one instance, so each member
// computes a part of it. Immutable: any thread may read it.
class SharedArrays {
 public:
  // bytes(): the size of the memory for such arrays, in bytes. The first zero_bytes() bytes of it
  // must be zero before the first member constructs a SharedArrays.
  static std::size_t bytes(const ArrayLayout& layout);
  static std::size_t zero_bytes(const ArrayLayout& layout);

  // `memory` must outlive this object. All members pass the same layout, and `member` numbers from
  // 0 to `members` - 1. Throws std::invalid_argument if `memory` does not begin at a multiple of
  // kAlignment.
  SharedArrays(std::span<std::byte> memory, const ArrayLayout& layout, int member, int members);

  // Returns no array (has_room() is false) if the layout does not contain it.
  SharedArray array(ArrayKind kind, std::size_t number) const;

  int members() const { return members_; }
  // The index in 0, ..., `count` - 1 at which this member should begin to compute `count` arrays.
  // Each member begins at a different part.
  std::size_t first_of(std::size_t count) const {
    return count * static_cast<std::size_t>(member_) / static_cast<std::size_t>(members_);
  }

  static constexpr std::size_t kAlignment = 64;

 private:
  struct Room {
    std::size_t begin;  // in memory_
    std::size_t bytes;
    std::size_t flag;
  };
  std::span<std::byte> memory_;
  std::array<std::vector<Room>, kArrayKinds> rooms_;
  int member_;
  int members_;
};

template <class Fill>
void SharedArray::make(const Fill& fill) const {
  if (room_ == 0 || !claim()) return;
  Claimed mine(*flag_);
  if (fill(begin_)) mine.result = kReady;
}

}  // namespace grove::detail
