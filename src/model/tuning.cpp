// SPDX-License-Identifier: MIT
#include "model/tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "model/parse_number.h"

namespace grove::detail {
namespace {

constexpr Tunable kTunables[] = {
#define GROVE_TUNABLE(type, name, value, min, max, meaning, evidence) \
  {#name, &Tuning::name, min, max, meaning, evidence},
#include "model/tunables.def"
#undef GROVE_TUNABLE
};

struct DeprecatedName {
  std::string_view name;
  std::string_view now;  // the current name, or the value of the constant
};

constexpr DeprecatedName kRenamed[] = {
#define GROVE_RENAMED_TUNABLE(old, name) {old, name},
#define GROVE_FORMER_TUNABLE(name, value)
#include "model/former_tunables.def"
#undef GROVE_RENAMED_TUNABLE
#undef GROVE_FORMER_TUNABLE
};

constexpr DeprecatedName kFormer[] = {
#define GROVE_RENAMED_TUNABLE(old, name)
#define GROVE_FORMER_TUNABLE(name, value) {name, value},
#include "model/former_tunables.def"
#undef GROVE_RENAMED_TUNABLE
#undef GROVE_FORMER_TUNABLE
};

std::string_view current_name(std::string_view name) {
  const auto renamed = std::ranges::find(kRenamed, name, &DeprecatedName::name);
  return renamed == std::end(kRenamed) ? name : renamed->now;
}

void require_value_of_constant(const DeprecatedName& former, std::string_view value) {
  const auto number = parse_number(value, -1e15, 1e15);
  if (number != parse_number(former.now, -1e15, 1e15))
    throw std::invalid_argument(fmt::format("{}: found '{}'; expected {}, because it is a constant",
                                            former.name, value, former.now));
}

}  // namespace

std::span<const Tunable> tunables() {
  return kTunables;
}

std::span<const std::string> accepted_tunable_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Tunable& t : kTunables) all.push_back(t.name());
    for (const DeprecatedName& d : kRenamed) all.emplace_back(d.name);
    for (const DeprecatedName& d : kFormer) all.emplace_back(d.name);
    return all;
  }();
  return names;
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
  const std::string_view value = text.substr(std::min(name.size() + 1, text.size()));
  const auto former = std::ranges::find(kFormer, name, &DeprecatedName::name);
  if (former != std::end(kFormer)) return require_value_of_constant(*former, value);
  const auto tunable = std::ranges::find(kTunables, current_name(name), &Tunable::name);
  if (tunable == std::end(kTunables) || name.size() == text.size())
    throw std::invalid_argument(
        fmt::format("found '{}'; expected NAME=VALUE with the name of a parameter", text));
  std::visit(
      [&](auto at) {
        using Number = std::remove_reference_t<decltype(tuning.*at)>;
        const auto number = parse_number(value, static_cast<Number>(tunable->min),
                                         static_cast<Number>(tunable->max));
        if (!number)
          throw std::invalid_argument(fmt::format(
              "{}: found '{}'; expected {} from {} to {}", name, value,
              std::is_integral_v<Number> ? "an integer" : "a number", tunable->min, tunable->max));
        tuning.*at = *number;
      },
      tunable->place);
}

}  // namespace grove::detail
