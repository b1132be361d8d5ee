// SPDX-License-Identifier: MIT
#include "search/splits.h"

#include <array>
#include <optional>

#include "conflicts/symmetry_reasoning.h"

namespace grove::detail {
namespace {

struct Rule {
  Technique technique;
  std::optional<Split> (*split)(const Conflict&, std::span<const Path>, const World&,
                                const Corridors&);
};

constexpr std::array kRules = {
    Rule{Technique::kTarget, target_split},
    Rule{Technique::kCorridor, corridor_split},
};

}  // namespace

void splits_of(const Conflict& conflict, std::span<const Path> paths, const Problem& problem,
               Techniques techniques, std::vector<Split>& splits) {
  splits.push_back(split(conflict));
  for (const Rule& rule : kRules)
    if (techniques.has(rule.technique))
      if (const auto split =
              rule.split(conflict, paths, problem.instance.world(), problem.corridors))
        splits.push_back(*split);
}

}  // namespace grove::detail
