// SPDX-License-Identifier: MIT
// Shrinks a failing case.
#pragma once

#include <functional>
#include <vector>

#include "model/limits.h"
#include "tests/fuzz/fuzz_case.h"

namespace grove::detail::fuzz {

// Returns all valid cases that are one step simpler: one agent, task, agent of a task, passable
// cell, row or column less, or one option reset to its default. The largest changes come first.
std::vector<FuzzCase> simpler_cases(const FuzzCase& fuzz_case);

// Takes steps while the case still fails, and stops early if `limits` are reached. The result
// fails; if no limit was reached, no case that is one step simpler fails.
FuzzCase shrink(FuzzCase fuzz_case, const std::function<bool(const FuzzCase&)>& fails,
                const Limits& limits);

}  // namespace grove::detail::fuzz
