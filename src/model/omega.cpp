// SPDX-License-Identifier: MIT
#include "model/omega.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/parse_number.h"

namespace grove::detail {
namespace {

constexpr double kLargest = 1e6;
constexpr const char* kExpected = "expected a number from 0 to 1e6 with at most 9 decimals, or inf";

}  // namespace

Omega Omega::from_double(double value) {
  if (!(value >= 0 && value <= kLargest)) throw std::invalid_argument(kExpected);
  return Omega(std::llround(value * static_cast<double>(kUnit)));
}

Omega Omega::parse(std::string_view text) {
  if (text == "inf") return infinite();
  const auto value = parse_number<double>(text);
  if (!value) throw std::invalid_argument(kExpected);
  const Omega omega = from_double(*value);
  // Rejects text with more than 9 decimals: the double nearest to the number in the text must be
  // equal to the double nearest to a multiple of 1e-9.
  if (omega.value() != *value) throw std::invalid_argument(kExpected);
  return omega;
}

double Omega::value() const {
  if (is_infinite()) return std::numeric_limits<double>::infinity();
  return static_cast<double>(billionths_) / static_cast<double>(kUnit);
}

std::string Omega::to_string() const {
  return is_infinite() ? "inf" : fmt::format("{}", value());
}

}  // namespace grove::detail
