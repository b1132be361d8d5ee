// SPDX-License-Identifier: MIT
// Arrays in shared memory, which several processes compute together and all of them read. This file
// defines the kinds of arrays, their layout in memory, and the protocol by which one process
// computes each array.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/limits.h"

namespace grove::detail {

// The content of an array. Arrays of one kind are numbered from 0.
enum class ArrayKind : std::uint8_t {
  kDistances,      // 16-bit distances (DistanceFields); number: index of the target set
  kStopsOfStates,  // the stop at each state (AgentStops); number: agent
  kSequenceTable,  // costs to go (CostToGo); number: agent
};
inline constexpr int kArrayKinds = 3;

// By kind and number: the size of the array in bytes; 0: the array does not exist.
using ArrayLayout = std::array<std::vector<std::size_t>, kArrayKinds>;

class SharedArrays;

// A reference to one array of a SharedArrays, or to none. Thread-safe.
class SharedArray {
 public:
  SharedArray() = default;  // refers to no array

  // True if this refers to an array of at least `bytes` bytes.
  bool has_room(std::size_t bytes) const { return bytes <= room_; }

  // Computes the array, unless another process or thread has already started to. To compute it,
  // calls fill(begin), where `begin` points to the memory of the array, which has the size given in
  // the layout. fill() must return true on success, and must write the same bytes in every process.
  // If it returns false or throws, the array remains unavailable. Does nothing if this refers to no
  // array.
  template <class Fill>
  void make(const Fill& fill) const;

  // Returns the array if it is complete. If another process or thread is computing it, waits up to
  // 1 s. Returns nullptr if this refers to no array, if the computation failed or did not start, or
  // if the wait ended after 1 s or at a limit. In that case the caller must compute the data in
  // memory of its own.
  const std::byte* await(const Limits& limits) const;

  // Calls make(), then await().
  template <class Fill>
  const std::byte* get(const Limits& limits, const Fill& fill) const {
    make(fill);
    return await(limits);
  }

 private:
  friend class SharedArrays;
  // The state of an array, stored in shared memory.
  enum Progress : std::uint32_t { kEmpty, kClaimed, kReady, kFailed };
  using Flag = std::atomic<std::uint32_t>;
  static_assert(Flag::is_always_lock_free, "else it would be of one process alone");

  SharedArray(Flag* flag, std::byte* begin, std::size_t room)
      : flag_(flag), begin_(begin), room_(room) {}
  bool claim() const;
  // Publishes `result` to all processes when it is destroyed. After an exception, `result` is
  // kFailed.
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

// All arrays of a layout, in memory that the caller owns and that several processes, the *members*,
// have mapped. All members need the same data of one instance, so each member computes a part of
// it. Immutable: any thread may read it.
class SharedArrays {
 public:
  // bytes(): the size in bytes of the memory for all arrays of a layout. Its first zero_bytes()
  // bytes must be zero before the first member constructs a SharedArrays.
  static std::size_t bytes(const ArrayLayout& layout);
  static std::size_t zero_bytes(const ArrayLayout& layout);

  // `memory` must have at least bytes(layout) bytes, and must outlive this object and every
  // SharedArray that refers to it. All members must pass the same layout, and different numbers
  // `member` from 0 to `members` - 1. Throws std::invalid_argument if `memory` does not begin at a
  // multiple of kAlignment.
  SharedArrays(std::span<std::byte> memory, const ArrayLayout& layout, int member, int members);

  // The array with this kind and number. If the layout does not contain it, the result refers to no
  // array.
  SharedArray array(ArrayKind kind, std::size_t number) const;

  int members() const { return members_; }
  // Of `count` arrays, the index of the array that this member should compute first. The members'
  // first arrays are spread evenly, so that members seldom wait for one another.
  std::size_t first_of(std::size_t count) const {
    return count * static_cast<std::size_t>(member_) / static_cast<std::size_t>(members_);
  }

  static constexpr std::size_t kAlignment = 64;

 private:
  struct Room {
    std::size_t begin;  // offset in memory_
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
