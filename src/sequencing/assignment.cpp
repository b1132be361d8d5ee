// SPDX-License-Identifier: MIT
// The Hungarian method in the form of successive shortest augmenting paths (Kuhn 1955; Jonker and
// Volgenant 1987). Rows are added one by one, each along a shortest augmenting path in reduced
// costs. The dual variables of rows and columns keep the reduced costs non-negative.
#include "sequencing/assignment.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr int kNone = -1;

class Assignment {
 public:
  explicit Assignment(const std::vector<std::vector<std::int64_t>>& cost)
      : cost_(cost),
        columns_(cost.empty() ? 0 : static_cast<int>(cost.front().size())),
        row_dual_(cost.size()),
        column_dual_(columns_),
        row_of_(columns_, kNone) {}

  // Adds a row. Returns false if the rows added so far and this one have no assignment.
  bool add_row(int row) {
    distance_.assign(columns_, kForbidden);
    before_.assign(columns_, kNone);
    done_.assign(columns_, false);
    std::int64_t reached = 0;
    int column = kNone;
    for (int from = row; from != kNone; from = row_of_[column]) {
      relax(from, column, reached);
      column = nearest();
      if (column == kNone) return false;
      done_[column] = true;
      reached = distance_[column];
    }
    update_duals(row, reached);
    augment(row, column);
    return true;
  }

  std::vector<int> columns_of_rows() const {
    GROVE_CHECK(columns_ - std::ranges::count(row_of_, kNone) == std::ssize(cost_),
                "each row has one column");
    std::vector<int> result(cost_.size());
    for (int column = 0; column < columns_; ++column)
      if (row_of_[column] != kNone) result[row_of_[column]] = column;
    return result;
  }

  std::vector<std::int64_t> prices() const {
    std::vector<std::int64_t> result;
    for (const std::int64_t dual : column_dual_) result.push_back(-dual);
    return result;
  }

 private:
  void relax(int from, int via, std::int64_t reached) {
    for (int column = 0; column < columns_; ++column) {
      if (done_[column] || cost_[from][column] == kForbidden) continue;
      const std::int64_t through =
          reached + cost_[from][column] - row_dual_[from] - column_dual_[column];
      GROVE_ASSERT(via == kNone || through >= reached,
                   "the reduced costs of assigned rows are not negative");
      if (through >= distance_[column]) continue;
      distance_[column] = through;
      before_[column] = via;
    }
  }

  int nearest() const {
    int best = kNone;
    for (int column = 0; column < columns_; ++column)
      if (!done_[column] && distance_[column] < kForbidden &&
          (best == kNone || distance_[column] < distance_[best]))
        best = column;
    return best;
  }

  void update_duals(int row, std::int64_t reached) {
    row_dual_[row] += reached;
    for (int column = 0; column < columns_; ++column) {
      if (!done_[column]) continue;
      column_dual_[column] -= reached - distance_[column];
      if (row_of_[column] != kNone) row_dual_[row_of_[column]] += reached - distance_[column];
    }
  }

  void augment(int row, int column) {
    for (; before_[column] != kNone; column = before_[column])
      row_of_[column] = row_of_[before_[column]];
    row_of_[column] = row;
  }

  const std::vector<std::vector<std::int64_t>>& cost_;
  const int columns_;
  std::vector<std::int64_t> row_dual_;
  std::vector<std::int64_t> column_dual_;
  std::vector<int> row_of_;  // by column
  std::vector<std::int64_t> distance_;
  std::vector<int> before_;  // by column: the previous column on the path; kNone: `row` itself
  std::vector<bool> done_;
};

}  // namespace

std::optional<MinCostAssignment> min_cost_assignment(
    const std::vector<std::vector<std::int64_t>>& cost) {
  GROVE_ASSERT(
      std::ranges::all_of(cost, [&](const auto& row) { return row.size() == cost[0].size(); }),
      "all rows are of one length");
  Assignment assignment(cost);
  for (int row = 0; row < static_cast<int>(cost.size()); ++row)
    if (!assignment.add_row(row)) return std::nullopt;
  return MinCostAssignment{assignment.columns_of_rows(), assignment.prices()};
}

}  // namespace grove::detail
