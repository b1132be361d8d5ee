// SPDX-License-Identifier: MIT
// Finds the known word that is most similar to an unknown word, for error messages.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace grove::detail {

// The optimal string alignment distance: the number of edits, each of which inserts, deletes or
// changes a letter, or exchanges two adjacent letters.
std::size_t edit_distance(std::string_view from, std::string_view to);

// Returns the nearest of the words in `known` that are within two edits, and within one edit for
// each three letters of the shorter word; the first of several nearest words. Returns nullopt if
// there is no such word, or if `word` is very long.
std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known);

}  // namespace grove::detail
