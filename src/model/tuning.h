// SPDX-License-Identifier: MIT
// The numbers of the search that were chosen by measuring, or have yet to be.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace grove::detail {

// All of them stand in tunables.def, with what they do and what is known of them. None changes what
// is proven, only how fast and by which way. A value.
struct Tuning {
  using int64_t = std::int64_t;
#define GROVE_TUNABLE(type, name, value, least, most, what, measured) type name = value;
#include "model/tunables.def"
#undef GROVE_TUNABLE

  friend bool operator==(const Tuning&, const Tuning&) = default;
};

// One of these numbers.
struct Tunable {
  std::string_view member;
  std::variant<std::int64_t Tuning::*, double Tuning::*> place;
  double least;
  double most;
  std::string_view what;      // it does
  std::string_view measured;  // what stands behind the default; empty: nothing on record

  // On the command line: as the member, with '-' for '_'.
  std::string name() const;
  // The number in `tuning`, as short a text as is exact.
  std::string value(const Tuning& tuning) const;
};

// All of them, in the order of the struct.
std::span<const Tunable> tunables();
// "pair-expansions=20": sets one number. Throws std::invalid_argument, saying what was expected,
// where there is no such number or the text is none in its range.
void set(Tuning& tuning, std::string_view text);

}  // namespace grove::detail
