// SPDX-License-Identifier: MIT
// Tunable parameters of the search, with ranges and the measurements behind the defaults.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace grove::detail {

// The values of all parameters (tunables.def). Parameters affect the speed and the order of the
// search, and which plan and bounds it reaches, but never the validity of a plan or bound. A value
// type.
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
  std::string_view evidence;  // measurement that supports the default; empty: none is on record

  // The name on the command line, which is `member` with '-' in place of '_'.
  std::string name() const;
  // The parameter's value in `tuning`, as the shortest text that is parsed as exactly this value.
  std::string value(const Tuning& tuning) const;
};

// Descriptions of all parameters, in the order of the members of Tuning.
std::span<const Tunable> tunables();
// All names that set() accepts: those of tunables() and the deprecated names.
std::span<const std::string> accepted_tunable_names();
// Sets one parameter from text such as "pair-expansions=20". A deprecated name of a parameter sets
// that parameter. For the name of a former parameter, which is now a constant, only the value of
// the constant is accepted. Throws std::invalid_argument if `text` has another form, the parameter
// does not exist, or the value is not a number in its range. what() states what was expected.
void set(Tuning& tuning, std::string_view text);

}  // namespace grove::detail
