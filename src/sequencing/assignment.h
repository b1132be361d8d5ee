// SPDX-License-Identifier: MIT
// The assignment problem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace grove::detail {

// For rows that must not have a column.
inline constexpr std::int64_t kForbidden = std::int64_t{1} << 60;

// A column for every row, no two the same, at least total cost; none if there is no such
// assignment. cost[row][column]: not negative and below 1e15, or kForbidden; all rows of one
// length. O(rows^2 * columns).
std::optional<std::vector<int>> least_cost_assignment(
    const std::vector<std::vector<std::int64_t>>& cost);

}  // namespace grove::detail
