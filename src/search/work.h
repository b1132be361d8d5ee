// SPDX-License-Identifier: MIT
// Unit of effort ("work" in names): the deterministic measure of the computational cost of
// searches.
#pragma once

#include <cstdint>

// Effort is counted, not timed, so that a run can be repeated exactly. One unit is about one
// expanded label of the low level. Other operations count at the following rates.
namespace grove::detail::work {

// Rates for dividing the effort between tree search and primal search.
inline constexpr std::int64_t kPerCall = 16;      // units per low-level call, besides its labels
inline constexpr std::int64_t kStepsSeen = 4;     // path steps searched for conflicts, per unit
inline constexpr std::int64_t kStepsMoved = 8;    // path steps added or removed in tables, per unit
inline constexpr std::int64_t kStatesPriced = 5;  // states of a congestion distance field, per unit

// Rates that estimate the duration of an expansion: labels and calls as above, and the other
// operations in ExpansionCounts. Fitted by regression to the processor time of single expansions.
// *Measured* on six instances of 10 to 80 agents: a unit takes 0.11 to 0.26 microseconds,
// correlation 0.65 to 1.00. (With the rates above: 0.22 to 0.62 microseconds, correlation 0.49 to
// 0.99. They leave out MDDs, which take most of the time of a worker whose cache is nearly empty.)
// kPerGroup applies to groups that are compared in full or looked up; it was fitted when all groups
// of a list were compared.
inline constexpr double kPerOptimalNode = 0.55;
inline constexpr double kPerJointPair = 0.85;
inline constexpr double kPerSubproblem = 2;
inline constexpr double kPerGroup = 1.7;
inline constexpr double kPerStepSeen = 0.15;

}  // namespace grove::detail::work
