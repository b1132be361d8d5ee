// SPDX-License-Identifier: MIT
// Paths as constraint-tree nodes keep them: 3 bits a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "grove/model/plan.h"

namespace grove {

// A path without its start, which the agent knows. Immutable.
class PackedPath {
 public:
  PackedPath() = default;
  // `path` must not be empty and move at most one cell per step.
  PackedPath(const Grid& grid, const Path& path);

  // The path's cost: its number of steps.
  Time cost() const { return static_cast<Time>(steps_); }
  // Overwrites `path`, which keeps its capacity.
  void unpack(const Grid& grid, Cell start, Path& path) const;
  // Memory held besides the object itself.
  std::size_t heap_bytes() const;

 private:
  std::uint32_t steps_ = 0;
  std::unique_ptr<std::uint64_t[]> words_;  // 21 moves each, first move in the lowest bits
};

}  // namespace grove
