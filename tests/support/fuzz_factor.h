// SPDX-License-Identifier: MIT
// Number of fuzzing rounds, scaled by the environment variable GROVE_FUZZ_FACTOR.
#pragma once

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace grove::detail::testing {

// Returns `rounds` times GROVE_FUZZ_FACTOR (1 if unset). Throws std::invalid_argument if the
// variable is not an integer from 1 to INT_MAX.
inline int fuzz_rounds(int rounds) {
  const char* factor = std::getenv("GROVE_FUZZ_FACTOR");
  if (factor == nullptr) return rounds;
  const std::string_view text = factor;
  int times = 0;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), times);
  if (error != std::errc() || end != text.end() || times < 1)
    throw std::invalid_argument("GROVE_FUZZ_FACTOR: found '" + std::string(text) +
                                "'; expected an integer of at least 1");
  return rounds * times;
}

}  // namespace grove::detail::testing
