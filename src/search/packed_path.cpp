// SPDX-License-Identifier: MIT
// Encoding of steps. Code 0 is a wait. On a plain grid the other codes are offsets of the cell
// number, so that decoding does not read the map. In other worlds, code k + 1 is move k of the
// state.
#include "search/packed_path.h"

#include <algorithm>
#include <array>
#include <bit>

#include "model/assert.h"

namespace grove::detail {
namespace {

// Codes of a plain grid. On a grid of one column, horizontal and vertical moves have the same
// offsets, so two codes decode to the same cell.
class Offsets {
 public:
  static constexpr std::uint32_t kBits = 3;

  explicit Offsets(const World& world)
      : world_(world), moves_{0, 1, world.row_width(), -1, -world.row_width()} {}

  std::uint64_t code(State from, State to) const {
    return static_cast<std::uint64_t>(std::ranges::find(moves_, to - from) - moves_.begin());
  }
  bool has(State, std::uint64_t code) const { return code < moves_.size(); }
  State after(State from, std::uint64_t code) const { return from + moves_[code]; }
  bool is_step(State from, State to) const {
    return from == to || std::ranges::count(world_.moves(from), to) > 0;
  }

 private:
  const World& world_;
  std::array<State, 5> moves_;
};

class Numbers {
 public:
  explicit Numbers(const World& world) : world_(world) {}

  std::uint64_t code(State from, State to) const {
    const auto moves = world_.moves(from);
    return from == to
               ? 0
               : static_cast<std::uint64_t>(std::ranges::find(moves, to) - moves.begin()) + 1;
  }
  bool has(State from, std::uint64_t code) const { return code <= world_.moves(from).size(); }
  State after(State from, std::uint64_t code) const {
    return code == 0 ? from : world_.moves(from)[code - 1];
  }
  bool is_step(State, State) const { return true; }

 private:
  const World& world_;
};

// Calls work(codes, bits) with the encoding of this world and its number of bits per step.
template <class Work>
auto with_codes(const World& world, Work work) {
  if (world.is_plain() && world.row_width() > 0) return work(Offsets(world), Offsets::kBits);
  const auto most = static_cast<std::uint32_t>(world.max_moves());
  return work(Numbers(world),
              std::max(Offsets::kBits, static_cast<std::uint32_t>(std::bit_width(most))));
}

}  // namespace

std::size_t packed_words(const World& world, std::uint32_t steps) {
  return with_codes(world, [steps](const auto&, std::uint32_t bits) {
    const std::size_t per_word = 64 / bits;
    return (steps + per_word - 1) / per_word;
  });
}

void pack(const World& world, const Path& path, std::uint64_t* words) {
  GROVE_ASSERT(!path.empty(), "a path is not empty");
  with_codes(world, [&](const auto& codes, std::uint32_t bits) {
    const std::uint32_t per_word = 64 / bits;
    for (std::uint32_t step = 0; step + 1 < path.size(); ++step) {
      if (step % per_word == 0) words[step / per_word] = 0;
      const std::uint64_t code = codes.code(path[step], path[step + 1]);
      GROVE_ASSERT(codes.has(path[step], code), "a path makes at most one move each step");
      GROVE_ASSERT(codes.after(path[step], code) == path[step + 1],
                   "a packed step leads to the next state of the path");
      words[step / per_word] |= code << (step % per_word * bits);
    }
  });
}

void PackedSteps::unpack(const World& world, State start, Path& path) const {
  path.resize(steps + 1);
  path[0] = start;
  with_codes(world, [&](const auto& codes, std::uint32_t bits) {
    const std::uint32_t per_word = 64 / bits;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    State state = start;
    std::uint64_t word = 0;
    for (std::uint32_t step = 0; step < steps; ++step) {
      if (step % per_word == 0) word = words[step / per_word];
      GROVE_ASSERT(codes.has(state, word & mask), "an unpacked path is a walk");
      const State next = codes.after(state, word & mask);
      GROVE_ASSERT(codes.is_step(state, next), "an unpacked step is a move of the world");
      state = next;
      word >>= bits;
      path[step + 1] = state;
    }
  });
}

bool PackedSteps::is_walk(const World& world, State start) const {
  return with_codes(world, [&](const auto& codes, std::uint32_t bits) {
    const std::uint32_t per_word = 64 / bits;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    State state = start;
    for (std::uint32_t step = 0; step < steps; ++step) {
      const std::uint64_t code = words[step / per_word] >> (step % per_word * bits) & mask;
      if (!codes.has(state, code)) return false;
      const State next = codes.after(state, code);
      if (!codes.is_step(state, next)) return false;
      state = next;
    }
    return true;
  });
}

}  // namespace grove::detail
