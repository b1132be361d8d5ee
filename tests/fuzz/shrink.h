// SPDX-License-Identifier: MIT
// Shrinks a failing case.
#pragma once

#include <functional>
#include <vector>

#include "model/limits.h"
#include "tests/fuzz/fuzz_case.h"

namespace grove::detail::fuzz {

// Returns all valid cases that are one step simpler: one agent, task, agent of a task, passable
// cell, row or column is removed, or one option is reset to its default. The largest changes come
// first.
std::vector<FuzzCase> simpler_cases(const FuzzCase& fuzz_case);

// Simplifies the case step by step while it still fails, until `limits` are reached. The result
// fails. If no limit was reached, no case that is one step simpler fails.
FuzzCase shrink(FuzzCase fuzz_case, const std::function<bool(const FuzzCase&)>& fails,
                const Limits& limits);

}  // namespace grove::detail::fuzz
