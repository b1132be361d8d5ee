// SPDX-License-Identifier: MIT
// Proof that a process never reads an incomplete array.
//
// Claim: if await() returns an array, all of its bytes have been written, and no thread writes to
// it any more.
// Proof: the state of an array changes from kEmpty to kClaimed by compare-exchange. Therefore at
// most one thread of all members fills it. Only that thread stores the result: kReady (with release
// order, after the last byte) or kFailed. A reader has loaded kReady (with acquire order), hence it
// sees all bytes. No thread writes to an array in state kReady.
// If a member ends or becomes unresponsive while it fills an array, the array remains kClaimed. In
// this case no process reads the array, and each process computes its own copy of the data.
//
// Claim: the array that a process reads is equal to the array that it would compute. Proof: all
// members run the same program on the same instance (the code that sets up the members ensures
// this), and the content of an array depends only on these two.
#include "model/shared_arrays.h"

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>

#include "model/assert.h"

namespace grove::detail {
namespace {

// Computing the most expensive array takes some tens of milliseconds, and a multiple of that if
// many ranks share a core. If the wait is too short, two processes compute the same data, which
// costs only time and memory.
constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kNap = std::chrono::microseconds(200);

std::size_t aligned(std::size_t bytes) {
  return (bytes + SharedArrays::kAlignment - 1) / SharedArrays::kAlignment *
         SharedArrays::kAlignment;
}

}  // namespace

bool SharedArray::claim() const {
  std::uint32_t expected = kEmpty;
  return flag_->compare_exchange_strong(expected, kClaimed, std::memory_order_relaxed);
}

const std::byte* SharedArray::await(const Limits& limits) const {
  if (room_ == 0) return nullptr;
  const auto progress = [&] { return flag_->load(std::memory_order_acquire); };
  std::uint32_t now = progress();
  if (now == kClaimed) {
    const Limits::Clock::time_point end = limits.now() + kPatience;
    while ((now = progress()) == kClaimed && limits.now() < end && !limits.stop_requested())
      std::this_thread::sleep_for(kNap);
  }
  return now == kReady ? begin_ : nullptr;
}

std::size_t SharedArrays::zero_bytes(const ArrayLayout& layout) {
  std::size_t arrays = 0;
  for (const auto& kind : layout) arrays += kind.size();
  return aligned(arrays * sizeof(SharedArray::Flag));
}

std::size_t SharedArrays::bytes(const ArrayLayout& layout) {
  std::size_t bytes = zero_bytes(layout);
  for (const auto& kind : layout)
    for (const std::size_t room : kind) bytes += aligned(room);
  return bytes;
}

SharedArrays::SharedArrays(std::span<std::byte> memory, const ArrayLayout& layout, int member,
                           int members)
    : memory_(memory), member_(member), members_(members) {
  GROVE_ASSERT(memory.size() >= bytes(layout), "there is room for all arrays");
  if (reinterpret_cast<std::uintptr_t>(memory.data()) % kAlignment != 0)
    throw std::invalid_argument("memory for arrays must start at a multiple of kAlignment");
  std::size_t begin = zero_bytes(layout);
  std::size_t flag = 0;
  for (std::size_t kind = 0; kind < layout.size(); ++kind)
    for (const std::size_t room : layout[kind]) {
      rooms_[kind].push_back({begin, room, flag});
      begin += aligned(room);
      flag += sizeof(SharedArray::Flag);
    }
  GROVE_CHECK(begin == bytes(layout), "the arrays take exactly the memory of their layout");
  GROVE_CHECK(flag <= zero_bytes(layout), "the flags are in memory that is initially zero");
}

SharedArray SharedArrays::array(ArrayKind kind, std::size_t number) const {
  const std::vector<Room>& rooms = rooms_[static_cast<std::size_t>(kind)];
  if (number >= rooms.size()) return {};
  const Room& room = rooms[number];
  GROVE_ASSERT(room.begin + room.bytes <= memory_.size(), "an array is inside its memory");
  std::byte* const begin = memory_.data();
  // The bytes of the flag were initially zero, which represents an atomic integer with value 0.
  return {reinterpret_cast<SharedArray::Flag*>(begin + room.flag), begin + room.begin, room.bytes};
}

}  // namespace grove::detail
