// SPDX-License-Identifier: MIT
// One switch for longer fuzzing: the environment variable GROVE_FUZZ_FACTOR.
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace grove::testing {

// `rounds` times GROVE_FUZZ_FACTOR (1 if unset). Throws std::invalid_argument or std::out_of_range
// if that is no int of at least 1.
inline int fuzz_rounds(int rounds) {
  const char* factor = std::getenv("GROVE_FUZZ_FACTOR");
  if (factor == nullptr) return rounds;
  std::size_t read = 0;
  const std::string text = factor;
  const int times = std::stoi(text, &read);
  if (read != text.size() || times < 1)
    throw std::invalid_argument("GROVE_FUZZ_FACTOR: found '" + text + "'; expected at least 1");
  return rounds * times;
}

}  // namespace grove::testing
