// SPDX-License-Identifier: MIT
#include "search/result_cache.h"

#include <algorithm>
#include <iterator>

#include "model/assert.h"

namespace grove::detail {

std::int64_t SharedCache::next_number() {
  static std::atomic<std::int64_t> next{1};
  return next++;
}

void SharedCache::merge(const CacheDelta& found) {
  const bool keeps = keeps_new_entries_;
  NewEntries news;
  for (const auto& [id, known] : found.costs)
    if (subproblems.merge(id, known) && keeps) news.costs.emplace_back(id, known);
  for (const auto& [id, set] : found.mdds) mdds.add(id, set);
  for (const auto& p : found.pairs)
    if (excesses.merge_pair(p.first, p.second, p.agent, p.known) && keeps) news.pairs.push_back(p);
  for (const auto& g : found.groups)
    if (excesses.merge_group(g.agents, g.subproblems, g.known) && keeps) news.groups.push_back(g);
  if (!keeps) return;
  const std::lock_guard lock(news_mutex_);
  std::ranges::move(news.costs, std::back_inserter(news_.costs));
  std::ranges::move(news.pairs, std::back_inserter(news_.pairs));
  std::ranges::move(news.groups, std::back_inserter(news_.groups));
}

NewEntries SharedCache::take_new_entries() {
  keeps_new_entries_ = true;
  const std::lock_guard lock(news_mutex_);
  return std::exchange(news_, {});
}

void WorkerCache::use_shared_cache(std::shared_ptr<SharedCache> common) {
  if (common == common_) return;
  found_ = {};
  common_ = std::move(common);
}

SubproblemTable::CostBound WorkerCache::known(Id id) const {
  const auto found = found_.costs.find(id);
  return found == found_.costs.end() ? common_->subproblems.known(id) : found->second;
}

const Mdd* WorkerCache::paths(Id id, AgentIndex agent, const AgentSequencing& order,
                              std::span<const Constraint> constraints, Time cost,
                              const Limits& limits) {
  ++sets_asked_;
  const auto known = found_.mdds.find(id);
  MddCache::Set set = known != found_.mdds.end() ? known->second : common_->mdds.find(id);
  if (set) ++sets_known_;
  if (!set)
    set = MddCache::make(planner_, agent, order, constraints, cost,
                         static_cast<std::size_t>(max_mdd_nodes_), limits);
  if (!set) return nullptr;
  GROVE_ASSERT(set->empty() || set->cost() == cost, "a cached MDD has the requested cost");
  return (found_.mdds[id] = std::move(set)).get();
}

DependencyTable::ExcessBound WorkerCache::of_pair(Id first, Id second) const {
  const auto same = [&](const CacheDelta::Pair& p) {
    return p.first == first && p.second == second;
  };
  const auto found = std::ranges::find_if(found_.pairs, same);
  return found == found_.pairs.end() ? common_->excesses.of_pair(first, second) : found->known;
}

void WorkerCache::merge_pair(Id first, Id second, AgentIndex agent,
                             DependencyTable::ExcessBound known) {
  GROVE_ASSERT(std::ranges::none_of(found_.pairs,
                                    [&](const CacheDelta::Pair& p) {
                                      return std::pair(p.first, p.second) ==
                                             std::pair(first, second);
                                    }),
               "a worker has one entry of its own for a pair");
  found_.pairs.push_back({first, second, agent, known});
}

void WorkerCache::partners(Id first, std::vector<DependencyTable::Partner>& partners) const {
  common_->excesses.partners(first, partners);
  for (const CacheDelta::Pair& p : found_.pairs)
    if (p.first == first && p.known.excess > 0)
      partners.push_back({p.agent, p.second, p.known.excess});
}

DependencyTable::ExcessBound WorkerCache::of_group(const std::vector<Id>& subproblems) const {
  ++groups_asked_;
  DependencyTable::ExcessBound known = common_->excesses.of_group(subproblems);
  for (const DependencyTable::Group& group : found_.groups)
    if (group.subproblems == subproblems) known = DependencyTable::join(known, group.known);
  return known;
}

void WorkerCache::merge_group(const std::vector<AgentIndex>& agents,
                              const std::vector<Id>& subproblems,
                              DependencyTable::ExcessBound known) {
  found_.groups.push_back({agents, subproblems, known});
}

}  // namespace grove::detail
