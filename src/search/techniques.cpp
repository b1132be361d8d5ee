// SPDX-License-Identifier: MIT
#include "grove/search/techniques.h"

#include <algorithm>
#include <array>

namespace grove {
namespace {

struct Named {
  Technique technique;
  std::string_view name;
};

constexpr std::array kNames = {
    Named{Technique::kPrimal, "primal"},
    Named{Technique::kConfigurations, "configurations"},
    Named{Technique::kStrongBranching, "strong-branching"},
    Named{Technique::kBypass, "bypass"},
    Named{Technique::kFewestConflicts, "fewest-conflicts"},
    Named{Technique::kTarget, "target"},
    Named{Technique::kTraversal, "traversal"},
    Named{Technique::kSequenceSplits, "sequence-splits"},
    Named{Technique::kDependencies, "dependencies"},
    Named{Technique::kJointPaths, "joint-paths"},
    Named{Technique::kCostSplits, "cost-splits"},
    Named{Technique::kClusters, "clusters"},
    Named{Technique::kEstimates, "estimates"},
};

constexpr auto kAll = [] {
  std::array<Technique, kNames.size()> all{};
  std::ranges::transform(kNames, all.begin(), &Named::technique);
  return all;
}();

}  // namespace

Techniques Techniques::all() {
  Techniques set;
  for (Technique t : kAll) set.bits_ |= bit(t);
  return set;
}

Techniques Techniques::usual() {
  return all().without(Technique::kSequenceSplits);
}

std::span<const Technique> all_techniques() {
  return kAll;
}

std::string_view name_of(Technique technique) {
  return std::ranges::find(kNames, technique, &Named::technique)->name;
}

std::optional<Technique> parse_technique(std::string_view name) {
  const auto named = std::ranges::find(kNames, name, &Named::name);
  return named == kNames.end() ? std::nullopt : std::optional(named->technique);
}

}  // namespace grove
