// SPDX-License-Identifier: MIT
#include "grove/detail/search/memory.h"

#include <algorithm>

namespace grove::detail {

void CommonMemory::learn(const FoundOut& found) {
  for (const auto& [id, known] : found.costs) situations.learn(id, known);
  for (const auto& [id, set] : found.sets) path_sets.add(id, set);
  for (const auto& p : found.pairs) excesses.learn_pair(p.first, p.second, p.agent, p.known);
  for (const auto& g : found.groups) excesses.learn_group(g.agents, g.situations, g.known);
}

void Memory::turn_to(std::shared_ptr<CommonMemory> common) {
  if (common == common_) return;
  found_ = {};
  common_ = std::move(common);
  ++numbering_;
}

Situations::Known Memory::known(Id id) const {
  const auto found = found_.costs.find(id);
  return found == found_.costs.end() ? common_->situations.known(id) : found->second;
}

const OptimalPaths* Memory::paths(Id id, AgentIndex agent, const AgentOrder& order,
                                  std::span<const Constraint> constraints, Time cost,
                                  const Limits& limits) {
  ++sets_asked_;
  const auto known = found_.sets.find(id);
  PathSets::Set set = known != found_.sets.end() ? known->second : common_->path_sets.find(id);
  if (set) ++sets_known_;
  if (!set)
    set = PathSets::make(planner_, agent, order, constraints, cost,
                         static_cast<std::size_t>(most_set_nodes_), limits);
  if (!set) return nullptr;
  return (found_.sets[id] = std::move(set)).get();
}

Excesses::Known Memory::of_pair(Id first, Id second) const {
  const auto same = [&](const FoundOut::Pair& p) { return p.first == first && p.second == second; };
  const auto found = std::ranges::find_if(found_.pairs, same);
  return found == found_.pairs.end() ? common_->excesses.of_pair(first, second) : found->known;
}

void Memory::learn_pair(Id first, Id second, AgentIndex agent, Excesses::Known known) {
  found_.pairs.push_back({first, second, agent, known});
}

void Memory::partners(Id first, std::vector<Excesses::Partner>& partners) const {
  common_->excesses.partners(first, partners);
  for (const FoundOut::Pair& p : found_.pairs)
    if (p.first == first && p.known.excess > 0)
      partners.push_back({p.agent, p.second, p.known.excess});
}

Excesses::Known Memory::of_group(const std::vector<Id>& situations) const {
  Excesses::Known known;
  groups_listed_under(Excesses::newest(situations), [&](const Excesses::Group& group) {
    if (group.situations == situations) known = Excesses::join(known, group.known);
  });
  return known;
}

void Memory::learn_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                         Excesses::Known known) {
  found_.groups.push_back({agents, situations, known});
}

}  // namespace grove::detail
