// SPDX-License-Identifier: MIT
// Tunable parameters of the search. Most defaults were chosen by measuring.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace grove::detail {

// All parameters, as defined in tunables.def, each with its meaning and the evidence for its
// default. No parameter changes what is proven. They change only the speed and the order of the
// search. A value type.
struct Tuning {
  using int64_t = std::int64_t;
#define GROVE_TUNABLE(type, name, value, min, max, meaning, evidence) type name = value;
#include "model/tunables.def"
#undef GROVE_TUNABLE

  friend bool operator==(const Tuning&, const Tuning&) = default;
};

// Description of one parameter.
struct Tunable {
  std::string_view member;
  std::variant<std::int64_t Tuning::*, double Tuning::*> place;
  double min;
  double max;
  std::string_view meaning;
  std::string_view evidence;  // for the default; empty: no measurement is on record

  // The name on the command line: `member` with '-' for '_'.
  std::string name() const;
  // The value in `tuning`, as the shortest text that is exact.
  std::string value(const Tuning& tuning) const;
};

// All parameters, in the order of the struct.
std::span<const Tunable> tunables();
// All names that set() accepts: those of tunables(), and deprecated ones.
std::span<const std::string> accepted_tunable_names();
// Sets one parameter from text such as "pair-expansions=20". The deprecated name of a parameter
// sets the parameter; that of a former parameter, now a constant, accepts only its value. Throws
// std::invalid_argument, with what was expected, if the parameter does not exist or the value is
// not a number in its range.
void set(Tuning& tuning, std::string_view text);

}  // namespace grove::detail
