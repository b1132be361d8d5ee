// SPDX-License-Identifier: MIT
// Collects the statements about groups of agents that a table has.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "model/assert.h"
#include "search/covering.h"
#include "search/dependency_table.h"

namespace grove::detail {

// Replaces `statements` by each pair and group with a known positive excess under `subproblems` (by
// AgentIndex), once, with its greatest known excess. The order does not depend on when the results
// became known. `Table`: DependencyTable or WorkerCache. `partners`: workspace.
template <class Table>
void collect_excesses(const Table& table, const std::vector<DependencyTable::Id>& subproblems,
                      std::vector<DependencyTable::Partner>& partners,
                      std::vector<GroupExcess>& statements) {
  statements.clear();
  for (AgentIndex a = 0; a < std::ssize(subproblems); ++a) {
    partners.clear();
    table.partners(subproblems[a], partners);
    for (const DependencyTable::Partner& b : partners)
      if (subproblems[b.agent] == b.subproblem) statements.push_back({{a, b.agent}, b.excess});
  }
  table.groups_at(subproblems, [&](const DependencyTable::Group& group) {
    if (group.known.excess > 0) statements.push_back({group.agents, group.known.excess});
  });
  std::ranges::sort(statements, [](const GroupExcess& s, const GroupExcess& t) {
    return s.agents != t.agents ? s.agents < t.agents : s.excess > t.excess;
  });
  const auto repeats = [](const GroupExcess& s, const GroupExcess& t) {
    return s.agents == t.agents;
  };
  statements.erase(std::unique(statements.begin(), statements.end(), repeats), statements.end());
  GROVE_ASSERT(std::ranges::adjacent_find(statements, std::greater_equal<>(),
                                          &GroupExcess::agents) == statements.end(),
               "statements are about distinct groups, in ascending order");
  GROVE_ASSERT(std::ranges::all_of(statements,
                                   [](const GroupExcess& s) {
                                     return s.excess > 0 && s.agents.size() > 1 &&
                                            std::ranges::is_sorted(s.agents);
                                   }),
               "a statement gives two or more agents a positive excess");
}

}  // namespace grove::detail
