// SPDX-License-Identifier: MIT
// Runs a solver on one fuzz case and checks its answer.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "engine/solve.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {

// A solver under test, which can also be one with deliberate errors. The oracle's answer is passed
// to it, because such a solver needs the truth to make false claims.
using Solver = std::function<Solution(const Instance&, const SolveOptions&, const Limits&,
                                      const oracle::Answer& truth)>;

struct CaseResult {
  bool too_large = false;               // too large for the oracle; the solver was not called
  bool solvable = false;                // the oracle found a plan
  bool stopped = false;                 // a limit stopped the run
  Status status = Status::kUnknown;     // as the solver reports it
  std::vector<std::string> complaints;  // empty: no failure
};

// Default time limit of a run; a tenth of it applies if there is no plan. Reaching it is no
// failure: the run then counts as stopped.
inline constexpr std::chrono::milliseconds kPatience{2000};

// Runs the oracle and `solver`, and compares their answers. A short, repeatable run that reached no
// limit is repeated and must give the same answer; a deterministic run is repeated with another
// number of threads. Also complains if the solver throws or returns more than 3 s of processor time
// after the deadline.
CaseResult run_case(const FuzzCase& fuzz_case, const Solver& solver,
                    std::chrono::milliseconds patience = kPatience);

}  // namespace grove::detail::fuzz
