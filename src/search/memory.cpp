// SPDX-License-Identifier: MIT
#include "grove/search/memory.h"

#include <algorithm>

namespace grove {

void Memory::publish() {
  for (const auto& [id, known] : costs_) common_->situations.learn(id, known);
  for (const auto& [id, set] : sets_) common_->path_sets.add(id, set);
  for (const Pair& p : pairs_) common_->excesses.learn_pair(p.first, p.second, p.agent, p.known);
  for (const Group& g : groups_) common_->excesses.learn_group(g.agents, g.situations, g.known);
  costs_.clear();
  sets_.clear();
  pairs_.clear();
  groups_.clear();
}

void Memory::turn_to(std::shared_ptr<CommonMemory> common) {
  if (common == common_) return;
  costs_.clear();
  sets_.clear();
  pairs_.clear();
  groups_.clear();
  common_ = std::move(common);
}

Situations::Known Memory::known(Id id) const {
  const auto found = costs_.find(id);
  return found == costs_.end() ? common_->situations.known(id) : found->second;
}

const OptimalPaths* Memory::paths(Id id, AgentIndex agent, const AgentOrder& order,
                                  std::span<const Constraint> constraints, Time cost,
                                  const Limits& limits) {
  const auto known = sets_.find(id);
  if (known != sets_.end()) return known->second.get();
  PathSets::Set set = common_->path_sets.find(id);
  if (!set) set = PathSets::make(planner_, agent, order, constraints, cost, limits);
  if (!set) return nullptr;
  return (sets_[id] = std::move(set)).get();
}

Excesses::Known Memory::of_pair(Id first, Id second) const {
  const auto same = [&](const Pair& p) { return p.first == first && p.second == second; };
  const auto found = std::ranges::find_if(pairs_, same);
  return found == pairs_.end() ? common_->excesses.of_pair(first, second) : found->known;
}

void Memory::learn_pair(Id first, Id second, AgentIndex agent, Excesses::Known known) {
  pairs_.push_back({first, second, agent, known});
}

void Memory::partners(Id first, std::vector<Excesses::Partner>& partners) const {
  common_->excesses.partners(first, partners);
  for (const Pair& p : pairs_)
    if (p.first == first && p.known.excess > 0)
      partners.push_back({p.agent, p.second, p.known.excess});
}

Excesses::Known Memory::of_group(const std::vector<Id>& situations) const {
  ++groups_asked_;
  const auto found = std::ranges::find(groups_, situations, &Group::situations);
  return found == groups_.end() ? common_->excesses.of_group(situations) : found->known;
}

void Memory::learn_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                         Excesses::Known known) {
  groups_.push_back({agents, situations, known});
}

void Memory::groups(std::vector<std::vector<AgentIndex>>& groups) const {
  common_->excesses.groups(groups);
  for (const Group& group : groups_) groups.push_back(group.agents);
}

}  // namespace grove
