// SPDX-License-Identifier: MIT
#include "grove/detail/search/excesses.h"

#include <algorithm>
#include <mutex>

#include "grove/detail/model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kBytesPerPair = 64;  // about
constexpr std::size_t kBytesPerGroup = 160;

std::uint64_t key(Excesses::Id first, Excesses::Id second) {
  return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(second);
}

}  // namespace

Excesses::Known Excesses::of_pair(Id first, Id second) const {
  return parts_.with(parts_.part_of(first), [&](const Part& part) {
    const auto found = part.known.find(key(first, second));
    return found == part.known.end() ? Known() : found->second;
  });
}

void Excesses::learn_pair(Id first, Id second, AgentIndex agent, Known known) {
  parts_.with(parts_.part_of(first), [&](Part& part) {
    const auto [entry, is_new] = part.known.try_emplace(key(first, second), known);
    if (is_new) bytes_ += kBytesPerPair;
    entry->second = join(entry->second, known);
    if (known.excess == 0) return;
    auto& partners = part.partners[first];
    const auto same = [&](const Partner& p) { return p.agent == agent && p.situation == second; };
    const auto listed = std::ranges::find_if(partners, same);
    if (listed != partners.end())
      listed->excess = entry->second.excess;
    else
      partners.push_back({agent, second, known.excess});
  });
}

void Excesses::partners(Id first, std::vector<Partner>& partners) const {
  parts_.with(parts_.part_of(first), [&](const Part& part) {
    const auto found = part.partners.find(first);
    if (found != part.partners.end())
      partners.insert(partners.end(), found->second.begin(), found->second.end());
  });
}

Excesses::Known Excesses::of_group(const std::vector<Id>& situations) const {
  const std::shared_lock lock(groups_mutex_);
  const auto found = known_groups_.find(situations);
  return found == known_groups_.end() ? Known() : found->second;
}

void Excesses::learn_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                           Known known) {
  GROVE_ASSERT(agents.size() == situations.size() && std::ranges::is_sorted(agents),
               "a group is its agents in ascending order, and their situations");
  const std::lock_guard lock(groups_mutex_);
  groups_.insert(agents);
  const auto [entry, is_new] = known_groups_.try_emplace(situations, known);
  if (is_new) bytes_ += kBytesPerGroup;
  entry->second = join(entry->second, known);
}

void Excesses::groups(std::vector<std::vector<AgentIndex>>& groups) const {
  const std::shared_lock lock(groups_mutex_);
  groups.insert(groups.end(), groups_.begin(), groups_.end());
}

}  // namespace grove::detail
