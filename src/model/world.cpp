// SPDX-License-Identifier: MIT
#include "grove/model/world.h"

#include <algorithm>
#include <utility>

namespace grove {
namespace {

// Who leads to whom, the other way round; lists in ascending order.
Rows reversed(const Rows& rows) {
  std::vector<std::vector<std::int32_t>> back(static_cast<std::size_t>(rows.count()));
  for (std::int32_t from = 0; from < rows.count(); ++from)
    for (const std::int32_t to : rows[from]) back[to].push_back(from);
  Rows result;
  for (const auto& row : back) {
    for (const std::int32_t item : row) result.add(item);
    result.end_row();
  }
  return result;
}

bool same_sets(const Rows& a, const Rows& b) {
  for (std::int32_t row = 0; row < a.count(); ++row)
    if (!std::ranges::is_permutation(a[row], b[row])) return false;
  return true;
}

// The lists of both, each entry once.
Rows joined(const Rows& a, const Rows& b) {
  Rows both;
  for (std::int32_t row = 0; row < a.count(); ++row) {
    for (const std::int32_t item : a[row]) both.add(item);
    for (const std::int32_t item : b[row])
      if (std::ranges::count(a[row], item) == 0) both.add(item);
    both.end_row();
  }
  return both;
}

int longest_row(const Rows& rows) {
  std::size_t longest = 0;
  for (std::int32_t row = 0; row < rows.count(); ++row)
    longest = std::max(longest, rows[row].size());
  return static_cast<int>(longest);
}

}  // namespace

World::World(Rows moves)
    : places_(moves.count()), most_moves_(longest_row(moves)), moves_(std::move(moves)) {
  Rows back = reversed(moves_);
  is_symmetric_ = same_sets(moves_, back);
  if (is_symmetric_) return;
  neighbors_ = joined(moves_, back);
  has_other_neighbors_ = true;
  moves_back_ = std::move(back);
}

World::World(Rows moves, Place row_width)
    : places_(moves.count()),
      row_width_(row_width),
      most_moves_(longest_row(moves)),
      moves_(std::move(moves)) {}

}  // namespace grove
