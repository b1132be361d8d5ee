// SPDX-License-Identifier: MIT
#include "cores/core_components.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {

void CoreComponents::add(std::span<const AgentIndex> agents, Cost raised, bool is_unconditional) {
  const auto limit = static_cast<std::size_t>(std::ranges::max(agents)) + 1;
  if (component_of_.size() < limit) component_of_.resize(limit, -1);
  GroupExcess joined{{}, raised};
  for (const AgentIndex agent : agents) {
    if (component_of_[agent] < 0) {
      joined.agents.push_back(agent);
      continue;
    }
    GroupExcess& old = components_[component_of_[agent]];
    joined.excess += std::exchange(old.excess, 0);
    joined.agents.insert(joined.agents.end(), old.agents.begin(), old.agents.end());
    old.agents.clear();
  }
  std::ranges::sort(joined.agents);
  GROVE_CHECK(std::ranges::adjacent_find(joined.agents) == joined.agents.end(),
              "each agent is in one component");
  for (const AgentIndex agent : joined.agents)
    component_of_[agent] = static_cast<std::int32_t>(components_.size());
  if (is_unconditional && joined.agents.size() > 1 && joined.agents.size() <= kMaxGroup)
    excesses_.push_back(joined);
  components_.push_back(std::move(joined));
}

}  // namespace grove::detail
