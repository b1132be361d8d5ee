// SPDX-License-Identifier: MIT
// Linear assignment problem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace grove::detail {

// Cost of a pair (row, column) that is not allowed.
inline constexpr std::int64_t kForbidden = std::int64_t{1} << 60;

// Returns the column of each row in an assignment of least total cost. Each row gets a column of
// its own. Returns nullopt if no such assignment exists. cost[row][column]: at least 0 and less
// than 1e15, or kForbidden; all rows have the same length. O(rows^2 * columns).
std::optional<std::vector<int>> min_cost_assignment(
    const std::vector<std::vector<std::int64_t>>& cost);

}  // namespace grove::detail
