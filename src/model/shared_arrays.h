// SPDX-License-Identifier: MIT
// Arrays that several processes make together and all of them read: which there are, where they
// lie, and who makes which.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/limits.h"

namespace grove::detail {

// What an array holds, and by what such arrays are numbered.
enum class ArrayKind : std::uint8_t {
  kDistances,      // distances of 16 bits (DistanceFields); by set of states
  kStopsOfStates,  // the stop at each state (AgentStops); by agent
  kSequenceTable,  // costs to go (Completions); by agent
};
inline constexpr int kArrayKinds = 3;

// How many bytes each array may take, by kind and number; 0: there is none.
using ArrayLayout = std::array<std::vector<std::size_t>, kArrayKinds>;

class SharedArrays;

// One of the arrays, or none. Refers to the SharedArrays that it is of. Any thread may use it.
class SharedArray {
 public:
  SharedArray() = default;  // none

  // There is one, with room for so many bytes.
  bool has_room(std::size_t bytes) const { return bytes <= room_; }

  // Makes the array unless another process, or thread, has begun to: calls fill(begin), which is
  // given room() bytes, says whether it succeeded, and must give the same bytes in all processes.
  template <class Fill>
  void make(const Fill& fill) const;

  // The array as it was made; waits for who makes it, but not for long. Null: each has to make its
  // own, for it could not be made, nobody has begun to, whoever did does not go on, or `limits`
  // struck.
  const std::byte* await(const Limits& limits) const;

  // Makes it or waits for it.
  template <class Fill>
  const std::byte* get(const Limits& limits, const Fill& fill) const {
    make(fill);
    return await(limits);
  }

 private:
  friend class SharedArrays;
  // What is said of an array in the memory shared.
  enum Progress : std::uint32_t { kUntouched, kInHand, kReady, kRefused };
  using Flag = std::atomic<std::uint32_t>;
  static_assert(Flag::is_always_lock_free, "else it would be of one process alone");

  SharedArray(Flag* flag, std::byte* begin, std::size_t room)
      : flag_(flag), begin_(begin), room_(room) {}
  bool claim() const;
  // Whatever comes of it, others hear of it.
  class Claimed {
   public:
    explicit Claimed(Flag& flag) : flag_(flag) {}
    ~Claimed() { flag_.store(result, std::memory_order_release); }
    Claimed(const Claimed&) = delete;
    Claimed& operator=(const Claimed&) = delete;
    Progress result = kRefused;

   private:
    Flag& flag_;
  };

  Flag* flag_ = nullptr;
  std::byte* begin_ = nullptr;
  std::size_t room_ = 0;
};

// All arrays of a layout in memory that somebody else owns, and that any number of processes, the
// *members*, may have mapped. What all of them compute alike from one instance each computes a
// share of. Does not change; any thread may use it.
class SharedArrays {
 public:
  // The memory that such arrays take, in bytes; so many of them, at the beginning, must be zero
  // before the first member makes this.
  static std::size_t bytes(const ArrayLayout& layout);
  static std::size_t zero_bytes(const ArrayLayout& layout);

  // `memory` begins at a multiple of kAlignment, else throws std::invalid_argument, and must
  // outlive this. All members give the same layout, and numbers from 0 to `members` - 1.
  SharedArrays(std::span<std::byte> memory, const ArrayLayout& layout, int member, int members);

  // None where the layout has none.
  SharedArray array(ArrayKind kind, std::size_t number) const;

  int members() const { return members_; }
  // Of `count` arrays, where this member had better begin: each begins elsewhere.
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
