// SPDX-License-Identifier: MIT
// Paths as constraint-tree nodes keep them: 3 bits a step where no state has more than 7 moves,
// else as many as it takes, without the start, which the agent knows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// A path of `steps` steps packed somewhere else: 21 steps of 3 bits to a word, or fewer longer
// ones, the first in the lowest bits. A view; valid as long as the words are.
struct PackedSteps {
  std::uint32_t steps = 0;
  const std::uint64_t* words = nullptr;

  // The path's cost: its number of steps.
  Time cost() const { return static_cast<Time>(steps); }
  // Overwrites `path`, which keeps its capacity.
  void unpack(const World& world, State start, Path& path) const;
  // Is it one: a walk in this world? What was packed by pack() is; what came from elsewhere must be
  // asked before it is unpacked.
  bool is_walk(const World& world, State start) const;
};

// How many words a path of so many steps takes.
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
