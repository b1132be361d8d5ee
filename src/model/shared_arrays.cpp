// SPDX-License-Identifier: MIT
// Why nobody reads what is not there. An array goes from untouched to in hand by compare-exchange,
// so at most one thread of all members fills it, and that one alone stores what comes of it:
// ready, after the last byte (release), or refused. Who reads has seen ready (acquire), hence all
// bytes, and nobody writes to an array that is ready. A member that ends or stands still while it
// fills an array leaves it in hand for ever: then nobody reads it, and each makes its own.
//
// What is read is what one would have computed: members have the same program and the same instance
// (who makes them members makes sure of that), and what fills an array depends on these alone.
#include "model/shared_arrays.h"

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>

#include "model/assert.h"

namespace grove::detail {
namespace {

// The dearest array takes some ten milliseconds, with many ranks on a core a multiple of that. What
// is made twice costs no more than memory.
constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kNap = std::chrono::microseconds(200);

std::size_t aligned(std::size_t bytes) {
  return (bytes + SharedArrays::kAlignment - 1) / SharedArrays::kAlignment *
         SharedArrays::kAlignment;
}

}  // namespace

bool SharedArray::claim() const {
  std::uint32_t expected = kUntouched;
  return flag_->compare_exchange_strong(expected, kInHand, std::memory_order_relaxed);
}

const std::byte* SharedArray::await(const Limits& limits) const {
  if (room_ == 0) return nullptr;
  const auto progress = [&] { return flag_->load(std::memory_order_acquire); };
  std::uint32_t now = progress();
  if (now == kInHand) {
    const Limits::Clock::time_point end = limits.now() + kPatience;
    while ((now = progress()) == kInHand && limits.now() < end && !limits.stop_requested())
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
    throw std::invalid_argument("memory for arrays must begin at a multiple of kAlignment");
  std::size_t begin = zero_bytes(layout);
  std::size_t flag = 0;
  for (std::size_t kind = 0; kind < layout.size(); ++kind)
    for (const std::size_t room : layout[kind]) {
      rooms_[kind].push_back({begin, room, flag});
      begin += aligned(room);
      flag += sizeof(SharedArray::Flag);
    }
}

SharedArray SharedArrays::array(ArrayKind kind, std::size_t number) const {
  const std::vector<Room>& rooms = rooms_[static_cast<std::size_t>(kind)];
  if (number >= rooms.size()) return {};
  const Room& room = rooms[number];
  std::byte* const begin = memory_.data();
  // Its bytes were zero, which is what an atomic of an integral type is that was made with 0.
  return {reinterpret_cast<SharedArray::Flag*>(begin + room.flag), begin + room.begin, room.bytes};
}

}  // namespace grove::detail
