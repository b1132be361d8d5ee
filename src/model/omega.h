// SPDX-License-Identifier: MIT
// The suboptimality factor w and the test cost <= (1 + w) * lower bound.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace grove::detail {

// The sum of all agents' costs, or a bound on it, in steps.
using Cost = std::int64_t;
// Greater than the cost of every plan.
inline constexpr Cost kInfiniteCost = std::int64_t{1} << 60;

// w in "cost <= (1 + w) * lower bound", as an exact decimal fraction, so that the test needs no
// floating point: a multiple of 1e-9, or infinite. A value type, ordered by size.
class Omega {
 public:
  constexpr Omega() = default;  // w = 0: optimal
  static constexpr Omega infinite() { return Omega(kInfinite); }

  // Reads text such as "0", "0.01", "1e-2" or "inf". Throws std::invalid_argument with what was
  // expected if the text is not a number, is negative, exceeds 1e6, or has more than 9 decimals.
  static Omega parse(std::string_view text);
  // Returns the nearest multiple of 1e-9. Throws std::invalid_argument if `value` is negative,
  // exceeds 1e6 or is not a number.
  static Omega from_double(double value);

  constexpr bool is_infinite() const { return billionths_ == kInfinite; }
  double value() const;           // for output only; infinity if infinite
  std::string to_string() const;  // shortest decimal, or "inf"

  // True if cost <= (1 + w) * bound, computed exactly. True for every cost if w is infinite.
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
