// SPDX-License-Identifier: MIT
// Compressed paths, as constraint-tree nodes store them: 3 bits per step if no state has more than
// 7 moves, otherwise as many as needed. The start is not stored, because it is the start of the
// agent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// View of a packed path of `steps` steps. A word holds 21 steps of 3 bits, or fewer steps of more
// bits, with the first step in the lowest bits. Valid as long as the words are.
struct PackedSteps {
  std::uint32_t steps = 0;
  const std::uint64_t* words = nullptr;

  // The path's cost: its number of steps.
  Time cost() const { return static_cast<Time>(steps); }
  // Replaces `path` by the states from `start` on; reuses its memory.
  void unpack(const World& world, State start, Path& path) const;
  // Tests whether the steps are a walk from `start` in this world. Steps that pack() wrote need no
  // test; test all others before unpack().
  bool is_walk(const World& world, State start) const;
};

// Number of words of a packed path of `steps` steps.
std::size_t packed_words(const World& world, std::uint32_t steps);
// Packs `path` (not empty, at most one move per step) into packed_words(path.size() - 1) words.
void pack(const World& world, const Path& path, std::uint64_t* words);

// A packed path that owns its words. Immutable.
class PackedPath {
 public:
  PackedPath() = default;  // no steps
  PackedPath(const World& world, const Path& path)
      : steps_(static_cast<std::uint32_t>(path.size() - 1)), words_(packed_words(world, steps_)) {
    pack(world, path, words_.data());
  }
  PackedSteps view() const { return {steps_, words_.data()}; }
  Time cost() const { return view().cost(); }

 private:
  std::uint32_t steps_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace grove::detail
