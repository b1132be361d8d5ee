// SPDX-License-Identifier: MIT
#include "search/techniques.h"

#include <algorithm>

namespace grove::detail {

Techniques Techniques::defaults() {
  Techniques set;
  for (const NamedTechnique& t : kTechniques) set = set.with(t.technique);
  return set;
}

std::string_view name_of(Technique technique) {
  return std::ranges::find(kTechniques, technique, &NamedTechnique::technique)->name;
}

std::optional<Technique> parse_technique(std::string_view name) {
  const auto named = std::ranges::find(kTechniques, name, &NamedTechnique::name);
  return named == kTechniques.end() ? std::nullopt : std::optional(named->technique);
}

}  // namespace grove::detail
