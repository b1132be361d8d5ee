// SPDX-License-Identifier: MIT
// Where two plans collide (design, section 1; vertex and edge conflicts of CBS, Sharon et al.
// 2015).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grove/model/plan.h"
#include "grove/planning/constraint.h"

namespace grove {

// Two agents that are on one cell at one time, or that swap cells in one step.
struct Conflict {
  AgentIndex first = -1;
  AgentIndex second = -1;
  Cell cell = kNoCell;  // the shared cell; for a swap, the cell that `first` arrives on
  Cell from = kNoCell;  // kNoCell: vertex conflict; else the cell that `first` leaves and `second`
                        // arrives on
  Time time = 0;        // for a swap, the time of arrival

  bool is_swap() const { return from != kNoCell; }
};

// One agent and what it is forbidden.
struct AgentConstraint {
  AgentIndex agent = -1;
  Constraint constraint;
};

// The two branches of standard CBS splitting: every pair of paths without this conflict obeys at
// least one of them, so no conflict-free plan is lost.
std::array<AgentConstraint, 2> split(const Conflict& conflict);

// Finds conflicts among paths. Workspace of one thread: reuse it, do not share it.
class ConflictFinder {
 public:
  // `seed` decides between conflicts of equal time. `grid` must outlive this.
  ConflictFinder(const Grid& grid, std::uint64_t seed);

  // A conflict of least time, none if the paths are conflict-free. Agents rest on their last cells
  // for ever; paths are by AgentIndex. O(agents * time of the conflict).
  std::optional<Conflict> first(std::span<const Path> paths);

 private:
  struct Visit {
    std::int64_t stamp = -1;  // base_ + time of the last visit; older stamps are of earlier calls
    AgentIndex agent = -1;
  };

  void consider(const Conflict& conflict, std::optional<Conflict>& best) const;
  std::uint64_t priority(const Conflict& conflict) const;
  void visit_all(std::span<const Path> paths, Time time, std::optional<Conflict>& best);
  void find_swaps(std::span<const Path> paths, Time time, std::optional<Conflict>& best) const;

  std::uint64_t seed_;
  std::int64_t base_ = 0;
  std::array<std::vector<Visit>, 2> visits_;  // by parity of the time, then by cell
};

}  // namespace grove
