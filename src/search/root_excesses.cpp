// SPDX-License-Identifier: MIT
#include "search/root_excesses.h"

#include <algorithm>
#include <iterator>

#include "model/assert.h"
#include "search/known_excesses.h"

namespace grove::detail {

RootExcesses::RootExcesses(SharedCache& cache, const Tree& tree) : cache_(cache) {
  for (AgentIndex agent = 0; agent < std::ssize(tree.orders); ++agent)
    subproblems_.push_back(cache.subproblems.id(agent, *tree.orders[agent], {}));
}

std::vector<GroupExcess> RootExcesses::all() const {
  std::vector<DependencyTable::Partner> partners;
  std::vector<GroupExcess> excesses;
  collect_excesses(cache_.excesses, subproblems_, partners, excesses);
  return excesses;
}

void RootExcesses::add(std::span<const GroupExcess> excesses) {
  CacheDelta delta;
  for (const GroupExcess& excess : excesses) {
    GROVE_CHECK(excess.agents.size() > 1 && std::ranges::is_sorted(excess.agents),
                "a group has two agents or more, in ascending order");
    const DependencyTable::ExcessBound known{.excess = excess.excess};
    const auto id = [&](AgentIndex agent) { return subproblems_[agent]; };
    if (excess.agents.size() == 2) {
      const AgentIndex second = excess.agents.back();
      delta.pairs.push_back({id(excess.agents.front()), id(second), second, known});
      continue;
    }
    DependencyTable::Group group{excess.agents, {}, known};
    std::ranges::transform(excess.agents, std::back_inserter(group.subproblems), id);
    delta.groups.push_back(std::move(group));
  }
  cache_.merge(delta);
}

}  // namespace grove::detail
