// SPDX-License-Identifier: MIT
// Finds the known word that is most similar to an unknown one, for messages.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace grove::detail {

// Optimal string alignment distance. The edits are: insert, delete or change a letter, and exchange
// two adjacent letters.
std::size_t edit_distance(std::string_view from, std::string_view to);

// The most similar word of `known`; the first one of several. Returns nullopt if no word is within
// one edit for each three letters of the shorter word, and within two edits.
std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known);

}  // namespace grove::detail
