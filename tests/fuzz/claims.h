// SPDX-License-Identifier: MIT
// Holds what a solver says against the truth.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {

// Everything that is false in `solution`, or that it owes; empty: nothing. `truth` must not be
// kTooLarge. `omega` is what was asked for; `stopped`: a limit struck before the end.
std::vector<std::string> false_claims(const Instance& instance, const oracle::Answer& truth,
                                      Omega omega, const Solution& solution, bool stopped);

}  // namespace grove::detail::fuzz
