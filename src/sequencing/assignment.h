// SPDX-License-Identifier: MIT
// Linear assignment problem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace grove::detail {

// Cost of a pair (row, column) that is not allowed.
inline constexpr std::int64_t kForbidden = std::int64_t{1} << 60;

// An assignment of a column to each row, and prices of the columns: at least 0, and 0 for columns
// without a row. Each row has the column that costs it least, including the price.
struct MinCostAssignment {
  std::vector<int> columns;          // by row
  std::vector<std::int64_t> prices;  // by column
};

// Returns an assignment of least total cost. Each row gets a column of its own. Returns nullopt if
// no such assignment exists. cost[row][column]: at least 0 and less than 1e15, or kForbidden; all
// rows have the same length. O(rows^2 * columns).
std::optional<MinCostAssignment> min_cost_assignment(
    const std::vector<std::vector<std::int64_t>>& cost);

}  // namespace grove::detail
