// SPDX-License-Identifier: MIT
// Linear assignment problem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace grove::detail {

// Cost of a pair (row, column) that is not allowed.
inline constexpr std::int64_t kForbidden = std::int64_t{1} << 60;

// Returns the column of each row in an assignment of least total cost, no two rows with the same
// column. Returns nullopt if there is no such assignment. cost[row][column]: from 0 to below 1e15,
// or kForbidden; all rows have the same length. O(rows^2 * columns).
std::optional<std::vector<int>> min_cost_assignment(
    const std::vector<std::vector<std::int64_t>>& cost);

}  // namespace grove::detail
