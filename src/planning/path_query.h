// SPDX-License-Identifier: MIT
// What is asked of a low level, and what it answers.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "planning/conflict_avoidance_table.h"
#include "planning/constraint.h"
#include "planning/reservation_table.h"

namespace grove::detail {

enum class PathOutcome : std::uint8_t {
  kFound,
  kAboveCutoff,  // proven: no path costs `cutoff` or less (whether there is one is not known)
  kInfeasible,   // proven: there is no path
  kStopped,      // a limit struck, or too much would have to be done: nothing is known
};

// What one agent's path must obey, and how much it is worth. What it refers to is the caller's, for
// the time of the call.
struct PathQuery {
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

  std::span<const Constraint> constraints = {};  // obeyed also while resting at the end
  // Among equally cheap ways met, one of few conflicts with these is preferred; null: no matter.
  const ConflictAvoidanceTable* others = nullptr;
  Time cutoff = kNever;                   // dearer paths are of no use; kNever: any will do
  std::int64_t label_limit = kUnlimited;  // give up after about so many: kStopped

  // Paths to go around, in place of constraints; null: none.
  const ReservationTable* reservations = nullptr;
  // Labels come in order of time + (1 + greed) * cost to go. With any greed the path found may not
  // be of least cost; what is proven stays proven.
  int inflation_percent = 0;
  // Make do with the sequences that the completions know, at least one; kStopped if that is why
  // there is no path. The path found may be dearer than one of another sequence.
  bool known_sequences = false;
};

}  // namespace grove::detail
