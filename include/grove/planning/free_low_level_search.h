// SPDX-License-Identifier: MIT
// The low level of CBS when it chooses the order of the tasks itself.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "grove/model/limits.h"
#include "grove/model/plan.h"
#include "grove/planning/conflict_avoidance_table.h"
#include "grove/planning/constraint.h"
#include "grove/planning/free_goals.h"
#include "grove/planning/reservations.h"

namespace grove {

// Safe-interval path planning with one label per (cell, safe interval, state), a state being what
// is left to visit. The essay with the proof is at the head of free_low_level_search.cpp. Holds the
// workspace of one thread: reuse it, do not share it.
class FreeLowLevelSearch {
 public:
  enum class Outcome : std::uint8_t {
    kFound,
    kAbove,       // proven: no path costs `cutoff` or less (whether there is one is not known)
    kInfeasible,  // proven: no path realizes a sequence of the class under the constraints
    kStopped,     // a limit struck, or too much would have to be done: nothing is known
  };
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

  // `grid` must outlive this.
  explicit FreeLowLevelSearch(const Grid& grid);
  ~FreeLowLevelSearch();

  // Finds a path of least cost from the start at time 0 that realizes some sequence of the class
  // and obeys `constraints` (also while resting at the end), if that cost is at most `cutoff`
  // (kNever: any). Among equally cheap ways met it prefers few conflicts with `others` (may be
  // null). The path ends when the agent comes to rest: its cost is path.size() - 1. Widens the
  // completions of `goals` as needed. Gives up after expanding `most_labels`: kStopped. Writes
  // `path` only on kFound.
  Outcome find(FreeGoals& goals, std::span<const Constraint> constraints,
               const ConflictAvoidanceTable* others, Time cutoff, const Limits& limits, Path& path,
               std::int64_t most_labels = kUnlimited);

  // How to search around reservations, where a good path may be worth more than the best one late.
  struct Effort {
    int greed_percent = 0;  // labels come in order of time + (1 + greed) * cost to go
    std::int64_t most_labels = kUnlimited;  // give up: kStopped
    // Make do with the sequences that the completions know, at least one; kStopped if that is why
    // there is no path. The path found may be dearer than one of another sequence.
    bool known_sequences = false;
  };

  // The same around the paths of `reservations`, in place of constraints. The path found may
  // then not be of least cost, but costs at most `cutoff`; what is proven stays proven.
  Outcome find(FreeGoals& goals, const Reservations& reservations, const Effort& effort,
               Time cutoff, const Limits& limits, Path& path);

  // Labels expanded by all calls so far.
  std::int64_t expanded() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove
