// SPDX-License-Identifier: MIT
// Strict parsing of numbers from files and command lines.
#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace grove::detail {

// The decimal number in `text`. Returns nullopt unless the whole text is a number from `min` to
// `max`.
template <class Number>
std::optional<Number> parse_number(std::string_view text,
                                   Number min = std::numeric_limits<Number>::lowest(),
                                   Number max = std::numeric_limits<Number>::max()) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [parsed_to, error] = std::from_chars(text.data(), end, value);
  const bool is_number = error == std::errc() && parsed_to == end;
  return is_number && value >= min && value <= max ? std::optional(value) : std::nullopt;
}

}  // namespace grove::detail
