// SPDX-License-Identifier: MIT
// The known word that an unknown one resembles, for messages.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace grove::detail {

// Optimal string alignment distance: letters to add, to drop or to change, and neighbouring letters
// to exchange.
std::size_t edit_distance(std::string_view from, std::string_view to);

// The word of `known` that is nearest to `word`, the first of several; std::nullopt if none is
// near: at most one edit for each three letters of the shorter word, and at most two.
std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known);

}  // namespace grove::detail
