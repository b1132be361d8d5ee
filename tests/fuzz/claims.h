// SPDX-License-Identifier: MIT
// Checks the claims of a solver against the answer of the oracle.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {

// Returns all complaints about `solution`: false claims and missing results; empty if there are
// none. `truth` must not be kTooLarge. `omega` is the requested tolerance. `stopped`: a limit
// stopped the run.
std::vector<std::string> false_claims(const Instance& instance, const oracle::Answer& truth,
                                      Omega omega, const Solution& solution, bool stopped);

}  // namespace grove::detail::fuzz
