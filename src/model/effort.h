// SPDX-License-Identifier: MIT
// Unit of effort ("work" in names): the deterministic measure of the computational cost of
// searches.
#pragma once

#include <cstdint>

// Effort is counted, not timed, so that a run can be repeated exactly. One unit is about one
// expanded label of the low level. Other operations count at the following rates.
namespace grove::detail::effort {

// Rates for dividing the effort between the components of the engine.
inline constexpr std::int64_t kUnitsPerCall = 16;  // of the low level, besides its labels

// Operations of which this number counts as one unit.
inline constexpr std::int64_t kScannedSteps = 4;       // path steps searched for conflicts
inline constexpr std::int64_t kMovedSteps = 8;         // path steps added to or removed from tables
inline constexpr std::int64_t kFieldStates = 5;        // states of a congestion distance field
inline constexpr std::int64_t kTimedNodes = 2;         // nodes of time-expanded graphs
inline constexpr std::int64_t kJointStates = 2;        // generated joint states
inline constexpr std::int64_t kMoveTuples = 20;        // joint moves tried for a pattern database
inline constexpr std::int64_t kPricedLabels = 2;       // labels of a search under multipliers
inline constexpr std::int64_t kCountedSteps = 32;      // path steps counted between pricing rounds
inline constexpr std::int64_t kSolverVariables = 7;    // variables of a SAT solver, at each call
inline constexpr std::int64_t kSolverLiterals = 2100;  // literals of its clauses, at each conflict

// Units per round of the main loop of a SAT solver, and per literal of a clause that it learns.
// *Fitted* to the time of the solver in 19 core-guided searches of up to 40 s (20 to 200 agents):
// a unit takes 0.24 to 0.66 microseconds in the mean of a search. (With fixed rates per round and
// conflict, a unit took up to 7 times as long after 30 s as at the start.)
inline constexpr std::int64_t kPerSolverRound = 39;
inline constexpr std::int64_t kPerLearnedLiteral = 7;

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

}  // namespace grove::detail::effort
