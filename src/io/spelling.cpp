// SPDX-License-Identifier: MIT
#include "io/spelling.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kMaxEdits = 2;
constexpr std::size_t kLettersPerEdit = 3;
constexpr std::size_t kMaxWordLength = 64;  // longer words are not similar to any known word

}  // namespace

std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before(to.size() + 1);
  std::vector<std::size_t> last(to.size() + 1);
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t changed = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({changed, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last.back();
}

std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known) {
  if (word.size() > kMaxWordLength) return std::nullopt;
  std::optional<std::string_view> nearest;
  std::size_t least = kMaxEdits + 1;
  for (const std::string_view other : known) {
    const std::size_t allowed =
        std::min(kMaxEdits, std::min(word.size(), other.size()) / kLettersPerEdit);
    const std::size_t edits = edit_distance(word, other);
    if (edits > allowed || edits >= least) continue;
    nearest = other;
    least = edits;
  }
  return nearest;
}

}  // namespace grove::detail
