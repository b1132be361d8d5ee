// SPDX-License-Identifier: MIT
#include "grove/detail/search/situations.h"

#include <algorithm>
#include <tuple>

#include "grove/detail/model/assert.h"
#include "grove/detail/model/hash.h"

namespace grove::detail {
namespace {

constexpr Situations::Id kFree = -1;
constexpr std::size_t kFirstSize = 64;

std::size_t place_of(Situations::Id id) {
  return static_cast<std::size_t>(id) / Sharded<int>::kParts;
}

// Of values, not of addresses: the same in every run, so that tables are of the same size.
std::uint64_t hash_of(AgentIndex agent, const AgentOrder& order,
                      std::span<const Constraint> constraints) {
  const auto both = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 |
           static_cast<std::uint32_t>(b);
  };
  std::uint64_t hash = mixed_in(static_cast<std::uint64_t>(agent), order.sequences.forbidden_next);
  for (const Stop stop : order.sequences.prefix) hash = mixed_in(hash, stop);
  for (const Constraint& c : constraints)
    hash = mixed_in(mixed_in(mixed_in(hash, both(c.cell, c.from)), both(c.begin, c.end)),
                    static_cast<std::uint64_t>(c.kind));
  return hash;
}

auto key_of(const Constraint& c) {
  return std::tuple(c.kind, c.cell, c.from, c.begin, c.end);
}

}  // namespace

void canonical(std::vector<Constraint>& constraints) {
  std::ranges::sort(constraints, {}, key_of);
  constraints.erase(std::unique(constraints.begin(), constraints.end()), constraints.end());
}

void add_to_canonical(std::vector<Constraint>& constraints, const Constraint& more) {
  const auto at = std::ranges::lower_bound(constraints, key_of(more), {}, key_of);
  if (at == constraints.end() || *at != more) constraints.insert(at, more);
}

Situations::Id Situations::id(AgentIndex agent, const AgentOrder& order,
                              std::span<const Constraint> constraints) {
  GROVE_ASSERT(std::ranges::is_sorted(constraints, {}, key_of),
               "constraints are in canonical order");
  const std::uint64_t hash = hash_of(agent, order, constraints);
  const std::size_t number = hash >> (64 - Sharded<Part>::kBits);
  const Entry key{hash, &order, agent, 0, static_cast<std::uint32_t>(constraints.size()), {}};
  const Id at = parts_.with(number, [&](Part& part) {
    const std::size_t before = part.bytes();
    const Id id = part.find_or_add(key, constraints);
    bytes_ += part.bytes() - before;
    return id;
  });
  return at << Sharded<Part>::kBits | static_cast<Id>(number);
}

Situations::Known Situations::known(Id id) const {
  return parts_.with(parts_.part_of(id),
                     [&](const Part& part) { return part.entries[place_of(id)].known; });
}

Situation Situations::situation(Id id) const {
  return parts_.with(parts_.part_of(id), [&](const Part& part) {
    const Entry& entry = part.entries[place_of(id)];
    const auto constraints = std::span(part.constraints).subspan(entry.first, entry.count);
    return Situation{entry.order, entry.agent, {constraints.begin(), constraints.end()}};
  });
}

bool Situations::learn(Id id, Known learnt) {
  return parts_.with(parts_.part_of(id), [&](Part& part) {
    Known& known = part.entries[place_of(id)].known;
    const Known before = known;
    if (!known.exact && (learnt.exact || learnt.at_least > known.at_least)) known = learnt;
    known.hard = before.hard || learnt.hard;
    return known != before;
  });
}

Situations::Id Situations::Part::find_or_add(const Entry& key,
                                             std::span<const Constraint> constraints_of_key) {
  if (2 * entries.size() >= table.size()) grow();
  const std::size_t mask = table.size() - 1;
  const auto same = [&](const Entry& entry) {
    return entry.hash == key.hash && entry.agent == key.agent && entry.order == key.order &&
           std::ranges::equal(std::span(constraints).subspan(entry.first, entry.count),
                              constraints_of_key);
  };
  std::size_t at = key.hash & mask;
  for (; table[at] != kFree; at = (at + 1) & mask)
    if (same(entries[table[at]])) return table[at];
  const auto id = static_cast<Id>(entries.size());
  entries.push_back(key);
  entries.back().first = static_cast<std::uint32_t>(constraints.size());
  constraints.insert(constraints.end(), constraints_of_key.begin(), constraints_of_key.end());
  return table[at] = id;
}

void Situations::Part::grow() {
  table.assign(std::max(kFirstSize, 2 * table.size()), kFree);
  const std::size_t mask = table.size() - 1;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::size_t at = entries[i].hash & mask;
    while (table[at] != kFree) at = (at + 1) & mask;
    table[at] = static_cast<Id>(i);
  }
}

std::size_t Situations::Part::bytes() const {
  return entries.capacity() * sizeof(Entry) + constraints.capacity() * sizeof(Constraint) +
         table.capacity() * sizeof(Id);
}

}  // namespace grove::detail
