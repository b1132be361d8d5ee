// SPDX-License-Identifier: MIT
#include "search/dependency_table.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "model/assert.h"
#include "model/hash.h"

namespace grove::detail {
namespace {

constexpr std::size_t kBytesPerPartner = 2 * sizeof(DependencyTable::Partner);  // estimates
constexpr std::size_t kBytesPerGroup = 160;

std::uint32_t hash_of(DependencyTable::Id first, DependencyTable::Id second) {
  const auto both = static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(second);
  return static_cast<std::uint32_t>(hash_combine(0, both));
}

}  // namespace

std::array<std::size_t, 2> DependencyTable::rarest_two(const std::vector<Id>& subproblems) const {
  std::vector<std::tuple<std::size_t, Id, std::size_t>> members;
  for (std::size_t place = 0; place < subproblems.size(); ++place)
    members.emplace_back(subproblems_.constraint_bytes(subproblems[place]), subproblems[place],
                         place);
  std::ranges::partial_sort(members, members.begin() + 2, std::greater());
  GROVE_ASSERT(std::ranges::max(members) == members[0] && members[1] < members[0],
               "the rarest subproblem has the longest constraints");
  return {std::get<2>(members[0]), std::get<2>(members[1])};
}

template <class Item>
std::vector<Item>& DependencyTable::Lists<Item>::at(Id subproblem) {
  const std::size_t place = place_of(subproblem);
  if (place >= list_.size()) list_.resize(place + 1, -1);
  if (list_[place] < 0) {
    lists_.emplace_back();
    list_[place] = static_cast<std::int32_t>(lists_.size() - 1);
  }
  return lists_[static_cast<std::size_t>(list_[place])];
}

template <class What>
bool DependencyTable::merge(Id under, What what) {
  return parts_.with(parts_.part_of(under), [&](Part& part) {
    const std::size_t before = part.bytes();
    const bool is_news = what(part);
    bytes_ += part.bytes() - before;
    return is_news;
  });
}

HashIndex::Number DependencyTable::Part::find(Id first, Id second) const {
  return index.find(hash_of(first, second), [&](HashIndex::Number number) {
    return pairs[number].first == first && pairs[number].second == second;
  });
}

std::size_t DependencyTable::Part::bytes() const {
  return pairs.capacity() * sizeof(Pair) + index.bytes() + partners.bytes() + groups.bytes() +
         listed_partners * kBytesPerPartner + all_groups.size() * kBytesPerGroup;
}

DependencyTable::ExcessBound DependencyTable::of_pair(Id first, Id second) const {
  return parts_.with(parts_.part_of(first), [&](const Part& part) {
    const HashIndex::Number found = part.find(first, second);
    return found == HashIndex::kNone ? ExcessBound() : part.pairs[found].known;
  });
}

bool DependencyTable::merge_pair(Id first, Id second, AgentIndex agent, ExcessBound known) {
  GROVE_ASSERT(first != second, "the subproblems of two agents differ");
  return merge(first, [&](Part& part) {
    HashIndex::Number at = part.find(first, second);
    const bool is_new = at == HashIndex::kNone;
    if (is_new) {
      part.index.reserve_one();
      part.pairs.push_back({first, second, {}});
      at = part.index.add(hash_of(first, second));
    }
    const ExcessBound before = part.pairs[at].known;
    const ExcessBound now = part.pairs[at].known = join(before, known);
    GROVE_ASSERT(part.pairs[at].first == first && part.pairs[at].second == second,
                 "the entry found is that of the requested pair");
    GROVE_ASSERT(now.excess >= before.excess && now.exact >= before.exact,
                 "a known excess never gets weaker");
    GROVE_ASSERT(now.excess == before.excess || !before.exact, "no excess exceeds an exact one");
    GROVE_ASSERT(now.excess == known.excess || !known.exact, "no excess exceeds an exact one");
    if (known.excess > 0) part.list({agent, second, now.excess}, first);
    return is_new || now != before;
  });
}

void DependencyTable::Part::list(const Partner& partner, Id first) {
  auto& listed = partners.at(first);
  const auto known = std::ranges::find_if(listed, [&](const Partner& p) {
    return p.agent == partner.agent && p.subproblem == partner.subproblem;
  });
  if (known != listed.end()) {
    GROVE_ASSERT(partner.excess >= known->excess, "the excess of a partner never falls");
    known->excess = partner.excess;
    return;
  }
  listed.push_back(partner);
  ++listed_partners;
}

void DependencyTable::partners(Id first, std::vector<Partner>& partners) const {
  parts_.with(parts_.part_of(first), [&](const Part& part) {
    const auto listed = part.partners.of(first);
    partners.insert(partners.end(), listed.begin(), listed.end());
  });
}

// Returns -1 if there is no such group.
std::int32_t DependencyTable::Part::find_group(Id rarest, Id next,
                                               const std::vector<Id>& subproblems) const {
  for (const ListedGroup& listed : groups.of(rarest))
    if (listed.subproblem == next && all_groups[listed.number].subproblems == subproblems)
      return listed.number;
  return -1;
}

DependencyTable::ExcessBound DependencyTable::of_group(const std::vector<Id>& subproblems) const {
  const auto [rarest, next] = rarest_two(subproblems);
  return parts_.with(parts_.part_of(subproblems[rarest]), [&](const Part& part) {
    const auto found = part.find_group(subproblems[rarest], subproblems[next], subproblems);
    return found < 0 ? ExcessBound() : part.all_groups[found].known;
  });
}

bool DependencyTable::merge_group(const std::vector<AgentIndex>& agents,
                                  const std::vector<Id>& subproblems, ExcessBound known) {
  GROVE_ASSERT(
      agents.size() > 2 && agents.size() == subproblems.size() && std::ranges::is_sorted(agents),
      "a group is its agents in ascending order, and their subproblems");
  const auto [rarest, next] = rarest_two(subproblems);
  const Id under = subproblems[rarest];
  return merge(under, [&](Part& part) {
    const auto found = part.find_group(under, subproblems[next], subproblems);
    if (found < 0) {
      const auto number = static_cast<std::int32_t>(part.all_groups.size());
      part.all_groups.push_back({agents, subproblems, known});
      part.groups.at(under).push_back({agents[next], subproblems[next], number});
      GROVE_ASSERT(part.find_group(under, subproblems[next], subproblems) == number,
                   "a group that was added is found");
      return true;
    }
    ExcessBound& now = part.all_groups[found].known;
    const ExcessBound before = std::exchange(now, join(now, known));
    GROVE_ASSERT(part.all_groups[found].agents == agents,
                 "groups with the same subproblems have the same agents");
    GROVE_ASSERT((now.excess == before.excess || !before.exact) &&
                     (now.excess == known.excess || !known.exact),
                 "no excess of a group exceeds an exact one");
    return now != before;
  });
}

}  // namespace grove::detail
