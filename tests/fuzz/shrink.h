// SPDX-License-Identifier: MIT
// Shrinks a failing case.
#pragma once

#include <functional>
#include <vector>

#include "model/limits.h"
#include "tests/fuzz/fuzz_case.h"

namespace grove::detail::fuzz {

// Returns all valid cases that are one step simpler: an agent, task, agent of a task, road, row,
// column or passable cell is removed; an agent, task or road is simplified; or an option is reset
// to its default. Removals of agents and tasks come first, those of cells last.
std::vector<FuzzCase> simpler_cases(const FuzzCase& fuzz_case);

// Simplifies a failing case step by step while it still fails, until `limits` are reached. The
// result fails. If no limit was reached, no case in simpler_cases() of the result fails.
FuzzCase shrink(FuzzCase fuzz_case, const std::function<bool(const FuzzCase&)>& fails,
                const Limits& limits);

}  // namespace grove::detail::fuzz
