// SPDX-License-Identifier: MIT
#include "search/techniques.h"

#include <algorithm>

namespace grove::detail {
namespace {

constexpr std::array kDeprecatedNames = {
    NamedTechnique{Technique::kLacam, "configurations"},
    NamedTechnique{Technique::kCorridor, "traversal"},
    NamedTechnique{Technique::kWdg, "dependencies"},
    NamedTechnique{Technique::kJointMdd, "joint-paths"},
    NamedTechnique{Technique::kLagrangianLns, "priced-plans"},
};

}  // namespace

Techniques Techniques::defaults() {
  Techniques set;
  for (const NamedTechnique& t : kTechniques) set = set.with(t.technique);
  return set;
}

std::string_view name_of(Technique technique) {
  return std::ranges::find(kTechniques, technique, &NamedTechnique::technique)->name;
}

std::optional<Technique> parse_technique(std::string_view name) {
  if (const auto named = std::ranges::find(kTechniques, name, &NamedTechnique::name);
      named != kTechniques.end())
    return named->technique;
  const auto old = std::ranges::find(kDeprecatedNames, name, &NamedTechnique::name);
  return old == kDeprecatedNames.end() ? std::nullopt : std::optional(old->technique);
}

}  // namespace grove::detail
