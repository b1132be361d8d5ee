// SPDX-License-Identifier: MIT
#include "search/splits.h"

#include <algorithm>
#include <array>
#include <optional>

#include "conflicts/symmetry_reasoning.h"
#include "model/assert.h"

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

bool is_about(const Split& split, const Conflict& conflict) {
  return split[0] != split[1] && std::ranges::all_of(split, [&](const AgentConstraint& side) {
           return side.agent == conflict.first || side.agent == conflict.second;
         });
}

}  // namespace

void splits_of(const Conflict& conflict, std::span<const Path> paths, const Problem& problem,
               Techniques techniques, std::vector<Split>& splits) {
  const auto before = std::ssize(splits);
  splits.push_back(split(conflict));
  for (const Rule& rule : kRules)
    if (techniques.has(rule.technique))
      if (const auto split =
              rule.split(conflict, paths, problem.instance.world(), problem.corridors))
        splits.push_back(*split);
  GROVE_ASSERT(std::all_of(splits.begin() + before, splits.end(),
                           [&](const Split& split) { return is_about(split, conflict); }),
               "a split has two different constraints on the agents of its conflict");
}

}  // namespace grove::detail
