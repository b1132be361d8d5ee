// SPDX-License-Identifier: MIT
#include "grove/search/situations.h"

#include <algorithm>
#include <tuple>

namespace grove {
namespace {

constexpr Situations::Id kFree = -1;
constexpr std::size_t kFirstSize = 1024;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  return hash ^ hash >> 29;
}

std::uint64_t hash_of(AgentIndex agent, const AgentOrder& order,
                      std::span<const Constraint> constraints) {
  const auto both = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 |
           static_cast<std::uint32_t>(b);
  };
  std::uint64_t hash =
      mixed(static_cast<std::uint64_t>(agent), reinterpret_cast<std::uintptr_t>(&order));
  for (const Constraint& c : constraints)
    hash = mixed(mixed(mixed(hash, both(c.cell, c.from)), both(c.begin, c.end)),
                 static_cast<std::uint64_t>(c.kind));
  return hash;
}

auto key_of(const Constraint& c) {
  return std::tuple(c.kind, c.cell, c.from, c.begin, c.end);
}

}  // namespace

void canonical(std::vector<Constraint>& constraints) {
  std::ranges::sort(constraints, {}, key_of);
  constraints.erase(std::ranges::unique(constraints).begin(), constraints.end());
}

Situations::Id Situations::id(AgentIndex agent, const AgentOrder& order,
                              std::span<const Constraint> constraints) {
  if (2 * entries_.size() >= table_.size()) grow();
  const std::uint64_t hash = hash_of(agent, order, constraints);
  const std::size_t mask = table_.size() - 1;
  std::size_t at = hash & mask;
  for (; table_[at] != kFree; at = (at + 1) & mask) {
    const Entry& entry = entries_[table_[at]];
    if (entry.hash == hash && same(entry, agent, order, constraints)) return table_[at];
  }
  const auto id = static_cast<Id>(entries_.size());
  entries_.push_back({hash,
                      &order,
                      agent,
                      static_cast<std::uint32_t>(constraints_.size()),
                      static_cast<std::uint32_t>(constraints.size()),
                      {}});
  constraints_.insert(constraints_.end(), constraints.begin(), constraints.end());
  table_[at] = id;
  return id;
}

bool Situations::same(const Entry& entry, AgentIndex agent, const AgentOrder& order,
                      std::span<const Constraint> constraints) const {
  return entry.agent == agent && entry.order == &order &&
         std::ranges::equal(std::span(constraints_).subspan(entry.first, entry.count), constraints);
}

void Situations::grow() {
  table_.assign(std::max(kFirstSize, 2 * table_.size()), kFree);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    std::size_t at = entries_[i].hash & mask;
    while (table_[at] != kFree) at = (at + 1) & mask;
    table_[at] = static_cast<Id>(i);
  }
}

std::size_t Situations::bytes() const {
  return entries_.capacity() * sizeof(Entry) + constraints_.capacity() * sizeof(Constraint) +
         table_.capacity() * sizeof(Id);
}

void Situations::clear() {
  entries_ = {};
  constraints_ = {};
  table_ = {};
}

}  // namespace grove
