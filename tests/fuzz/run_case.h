// SPDX-License-Identifier: MIT
// Runs one case through a solver and judges the answer.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "engine/solve.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {

// Any engine, or a liar. It is given the oracle's answer, so that it need not spend its time on it.
using Solver = std::function<Solution(const Instance&, const SolveOptions&, const Limits&,
                                      const oracle::Answer& truth)>;

struct CaseResult {
  bool too_large = false;               // for the oracle: the solver was not asked
  bool solvable = false;                // the oracle found a plan
  bool stopped = false;                 // a limit struck
  Status status = Status::kUnknown;     // what the solver said
  std::vector<std::string> complaints;  // empty: all is well
};

// How long a run that is not meant to be stopped may take. Not a test of speed: it is stopped then,
// and may say so.
inline constexpr std::chrono::milliseconds kPatience{2000};

// Asks the oracle, then `solver`, then holds one against the other; a short run that no limit
// struck is repeated and must end the same.
CaseResult run_case(const FuzzCase& fuzz_case, const Solver& solver,
                    std::chrono::milliseconds patience = kPatience);

}  // namespace grove::detail::fuzz
