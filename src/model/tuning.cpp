// SPDX-License-Identifier: MIT
#include "model/tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "model/parse_number.h"

namespace grove::detail {
namespace {

constexpr Tunable kTunables[] = {
#define GROVE_TUNABLE(type, name, value, least, most, what, measured) \
  {#name, &Tuning::name, least, most, what, measured},
#include "model/tunables.def"
#undef GROVE_TUNABLE
};

}  // namespace

std::span<const Tunable> tunables() {
  return kTunables;
}

std::string Tunable::name() const {
  std::string name(member);
  std::ranges::replace(name, '_', '-');
  return name;
}

std::string Tunable::value(const Tuning& tuning) const {
  return std::visit([&](auto at) { return fmt::format("{}", tuning.*at); }, place);
}

void set(Tuning& tuning, std::string_view text) {
  const std::string_view name = text.substr(0, text.find('='));
  const auto tunable = std::ranges::find(kTunables, name, &Tunable::name);
  if (tunable == std::end(kTunables) || name.size() == text.size())
    throw std::invalid_argument(fmt::format("found '{}'; expected NAME=VALUE", text));
  const std::string_view value = text.substr(name.size() + 1);
  std::visit(
      [&](auto at) {
        using Number = std::remove_reference_t<decltype(tuning.*at)>;
        const auto number = parse_number(value, static_cast<Number>(tunable->least),
                                         static_cast<Number>(tunable->most));
        if (!number)
          throw std::invalid_argument(
              fmt::format("{}: found '{}'; expected {} from {} to {}", name, value,
                          std::is_integral_v<Number> ? "an integer" : "a number", tunable->least,
                          tunable->most));
        tuning.*at = *number;
      },
      tunable->place);
}

}  // namespace grove::detail
