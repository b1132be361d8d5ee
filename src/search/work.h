// SPDX-License-Identifier: MIT
// What work is: the one measure of what searches do.
#pragma once

#include <cstdint>

// Work is counted in units of about one label of the low level expanded, and not timed, so that a
// run can be repeated. What else is done counts at these rates.
namespace grove::detail::work {

// What the tree and the primal search are weighed against each other by.
inline constexpr std::int64_t kPerCall = 16;      // of a low level, beside its labels
inline constexpr std::int64_t kStepsSeen = 4;     // to one unit: of a node's paths, looked through
inline constexpr std::int64_t kStepsMoved = 8;    // to one unit: of paths, into or out of a table
inline constexpr std::int64_t kStatesPriced = 5;  // to one unit: of a distance field by traffic

// How long an expansion takes: labels and calls as above, and what else it does (ExpansionCounts).
// By regression on the processor time of single ones: on six instances of 10 to 80 agents a unit
// takes 0.11 to 0.26 microseconds, and the correlation is 0.65 to 1.00. (Of what is weighed: 0.22
// to 0.62, and 0.49 to 0.99. It leaves the sets of optimal paths out; they are most of what a
// worker does that knows little yet.) A group is one that was looked at in full; its rate is from
// when all in a list were.
inline constexpr double kPerOptimalNode = 0.55;
inline constexpr double kPerJointPair = 0.85;
inline constexpr double kPerSituation = 2;
inline constexpr double kPerGroup = 1.7;
inline constexpr double kPerStepSeen = 0.15;

}  // namespace grove::detail::work
