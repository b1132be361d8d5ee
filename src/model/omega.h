// SPDX-License-Identifier: MIT
// The relative tolerance w (omega), and the test cost <= (1 + w) * lower bound in exact arithmetic.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace grove::detail {

// The cost of a plan, which is the sum of its agents' costs, or a bound on it; in time steps.
using Cost = std::int64_t;
// Greater than the cost of every plan.
inline constexpr Cost kInfiniteCost = std::int64_t{1} << 60;

// The tolerance w in "cost <= (1 + w) * lower bound". It is infinite or a multiple of 1e-9, so that
// the test needs no floating-point arithmetic. A value type, ordered by size.
class Omega {
 public:
  constexpr Omega() = default;  // w = 0: only optimal plans
  static constexpr Omega infinite() { return Omega(kInfinite); }

  // Parses text such as "0", "0.01", "1e-2" or "inf". Throws std::invalid_argument if the text is
  // neither a number from 0 to 1e6 nor "inf", or if the number is not a multiple of 1e-9 to within
  // the precision of a double. what() states what was expected.
  static Omega parse(std::string_view text);
  // Returns the nearest multiple of 1e-9. Throws std::invalid_argument if `value` is negative,
  // exceeds 1e6 or is not a number.
  static Omega from_double(double value);

  constexpr bool is_infinite() const { return billionths_ == kInfinite; }
  double value() const;           // rounded to double, for output; infinity if infinite
  std::string to_string() const;  // shortest text that parse() accepts for this value

  // True if cost <= (1 + w) * bound, evaluated in integer arithmetic. True for every cost if w is
  // infinite.
  constexpr bool accepts(Cost cost, Cost bound) const {
    if (is_infinite()) return true;
    return static_cast<Wide>(cost) * kUnit <= static_cast<Wide>(bound) * (kUnit + billionths_);
  }

  friend constexpr auto operator<=>(const Omega&, const Omega&) = default;

 private:
  __extension__ typedef __int128 Wide;
  static constexpr std::int64_t kUnit = 1'000'000'000;
  static constexpr std::int64_t kInfinite = INT64_MAX;
  explicit constexpr Omega(std::int64_t billionths) : billionths_(billionths) {}

  std::int64_t billionths_ = 0;
};

}  // namespace grove::detail
