// SPDX-License-Identifier: MIT
#include "grove/detail/search/excesses.h"

#include <algorithm>

#include "grove/detail/model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kBytesPerPair = 64;  // about
constexpr std::size_t kBytesPerGroup = 160;

std::uint64_t key(Excesses::Id first, Excesses::Id second) {
  return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(second);
}

}  // namespace

// Situations are numbered as they come up, in each part of their table.
Excesses::Id Excesses::newest(const std::vector<Id>& situations) {
  return *std::ranges::max_element(situations);
}

Excesses::Known Excesses::of_pair(Id first, Id second) const {
  return parts_.with(parts_.part_of(first), [&](const Part& part) {
    const auto found = part.known.find(key(first, second));
    return found == part.known.end() ? Known() : found->second;
  });
}

bool Excesses::learn_pair(Id first, Id second, AgentIndex agent, Known known) {
  return parts_.with(parts_.part_of(first), [&](Part& part) {
    const auto [entry, is_new] = part.known.try_emplace(key(first, second), known);
    if (is_new) bytes_ += kBytesPerPair;
    const Known before = entry->second;
    entry->second = join(before, known);
    const bool is_news = is_new || entry->second != before;
    if (known.excess == 0) return is_news;
    auto& partners = part.partners[first];
    const auto same = [&](const Partner& p) { return p.agent == agent && p.situation == second; };
    const auto listed = std::ranges::find_if(partners, same);
    if (listed != partners.end())
      listed->excess = entry->second.excess;
    else
      partners.push_back({agent, second, known.excess});
    return is_news;
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
  Known known;
  groups_listed_under(newest(situations), [&](const Group& group) {
    if (group.situations == situations) known = group.known;
  });
  return known;
}

bool Excesses::learn_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                           Known known) {
  GROVE_ASSERT(agents.size() == situations.size() && std::ranges::is_sorted(agents),
               "a group is its agents in ascending order, and their situations");
  const Id under = newest(situations);
  return parts_.with(parts_.part_of(under), [&](Part& part) {
    auto& groups = part.groups[under];
    const auto listed = std::ranges::find(groups, situations, &Group::situations);
    if (listed == groups.end()) {
      groups.push_back({agents, situations, known});
      bytes_ += kBytesPerGroup;
      return true;
    }
    const Known before = listed->known;
    listed->known = join(before, known);
    return listed->known != before;
  });
}

}  // namespace grove::detail
