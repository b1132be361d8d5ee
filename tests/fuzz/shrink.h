// SPDX-License-Identifier: MIT
// Makes a failing case small enough to understand.
#pragma once

#include <functional>
#include <vector>

#include "model/limits.h"
#include "tests/fuzz/fuzz_case.h"

namespace grove::detail::fuzz {

// Every valid case that is one step simpler: an agent, a task, a share in a task, a passable cell,
// a row or a column less, or a plainer option. Most drastic first.
std::vector<FuzzCase> simpler_cases(const FuzzCase& fuzz_case);

// Takes steps as long as the case still fails; stops early when `limits` strike. The result fails,
// and without a strike no case one step simpler does.
FuzzCase shrink(FuzzCase fuzz_case, const std::function<bool(const FuzzCase&)>& fails,
                const Limits& limits);

}  // namespace grove::detail::fuzz
