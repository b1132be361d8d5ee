// SPDX-License-Identifier: MIT
#include "search/subproblem_table.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <tuple>

#include "model/assert.h"
#include "model/hash.h"

namespace grove::detail {
namespace {

// Layout of a key: address of the AgentSequencing, agent, packed constraints. See key_begun().
constexpr std::size_t kBytesBeforeConstraints = sizeof(const AgentSequencing*) + sizeof(AgentIndex);

std::size_t place_of(SubproblemTable::Id id) {
  return static_cast<std::size_t>(id) / Sharded<int>::kParts;
}

template <class Value>
void append(Value value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
Value taken_from(std::string_view& bytes) {
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

// Returns a key without its constraints, which the caller appends. The buffer belongs to the
// calling thread and is valid until its next call.
std::string& key_begun(AgentIndex agent, const AgentSequencing& order) {
  thread_local std::string key;
  key.clear();
  append(&order, key);
  append(agent, key);
  return key;
}

AgentSubproblem subproblem_of(std::string_view key) {
  AgentSubproblem subproblem;
  subproblem.order = taken_from<const AgentSequencing*>(key);
  subproblem.agent = taken_from<AgentIndex>(key);
  subproblem.constraints.bytes = key;
  return subproblem;
}

// Hashes values instead of addresses, so that the tables have the same sizes in every run.
std::uint64_t hash_of(const AgentSequencing& order, std::string_view key) {
  std::uint64_t hash = order.sequences.forbidden_next;
  for (const Stop stop : order.sequences.prefix) hash = hash_combine(hash, stop);
  key.remove_prefix(sizeof &order);
  while (key.size() >= sizeof hash) hash = hash_combine(hash, taken_from<std::uint64_t>(key));
  for (const char byte : key) hash = hash_combine(hash, static_cast<unsigned char>(byte));
  return hash;
}

auto key_of(const Constraint& c) {
  return std::tuple(c.kind, c.cell, c.from, c.begin, c.end);
}

bool is_canonical(std::span<const Constraint> constraints) {
  return std::ranges::adjacent_find(constraints, std::greater_equal<>(), key_of) ==
         constraints.end();
}

}  // namespace

void canonical(std::vector<Constraint>& constraints) {
  std::ranges::sort(constraints, {}, key_of);
  constraints.erase(std::unique(constraints.begin(), constraints.end()), constraints.end());
  GROVE_ASSERT(is_canonical(constraints), "the canonical order is strictly ascending");
}

void add_to_canonical(std::vector<Constraint>& constraints, const Constraint& more) {
  const auto at = std::ranges::lower_bound(constraints, key_of(more), {}, key_of);
  if (at == constraints.end() || *at != more) constraints.insert(at, more);
  GROVE_ASSERT(is_canonical(constraints), "an added constraint keeps the canonical order");
}

SubproblemTable::Id SubproblemTable::id(AgentIndex agent, const AgentSequencing& order,
                                        std::span<const Constraint> constraints) {
  GROVE_ASSERT(is_canonical(constraints), "constraints are in canonical order");
  std::string& key = key_begun(agent, order);
  pack(constraints, key);
  return id_of_key(order, key);
}

SubproblemTable::Id SubproblemTable::id(const AgentSubproblem& subproblem) {
  std::string& key = key_begun(subproblem.agent, *subproblem.order);
  key += subproblem.constraints.bytes;
  return id_of_key(*subproblem.order, key);
}

SubproblemTable::Id SubproblemTable::id_of_key(const AgentSequencing& order, std::string_view key) {
  const std::uint64_t hash = hash_of(order, key);
  const std::size_t number = hash >> (64 - Sharded<Part>::kBits);
  const Id at = parts_.with(number, [&](Part& part) {
    const std::size_t before = part.bytes();
    const Id id = part.find_or_add(static_cast<std::uint32_t>(hash), key);
    GROVE_ASSERT(part.key(id) == key, "the entry found has the requested key");
    bytes_ += part.bytes() - before;
    return id;
  });
  return at << Sharded<Part>::kBits | static_cast<Id>(number);
}

std::size_t SubproblemTable::constraint_bytes(Id id) const {
  return parts_.with(parts_.part_of(id), [&](const Part& part) {
    return part.key(static_cast<Id>(place_of(id))).size() - kBytesBeforeConstraints;
  });
}

SubproblemTable::CostBound SubproblemTable::known(Id id) const {
  return parts_.with(parts_.part_of(id),
                     [&](const Part& part) { return part.entries[place_of(id)].known; });
}

AgentSubproblem SubproblemTable::subproblem(Id id) const {
  return parts_.with(parts_.part_of(id), [&](const Part& part) {
    return subproblem_of(part.key(static_cast<Id>(place_of(id))));
  });
}

bool SubproblemTable::merge(Id id, CostBound learnt) {
  return parts_.with(parts_.part_of(id), [&](Part& part) {
    CostBound& known = part.entries[place_of(id)].known;
    const CostBound before = known;
    if (!known.exact && (learnt.exact || learnt.lower_bound > known.lower_bound)) known = learnt;
    known.was_aborted = before.was_aborted || learnt.was_aborted;
    GROVE_ASSERT(!before.exact || learnt.lower_bound <= before.lower_bound,
                 "no lower bound exceeds an exact cost");
    GROVE_ASSERT(known.lower_bound >= before.lower_bound && known.exact >= before.exact,
                 "a known cost bound never gets weaker");
    return known != before;
  });
}

SubproblemTable::Id SubproblemTable::Part::find_or_add(std::uint32_t hash,
                                                       std::string_view sought) {
  const Id found = index.find(hash, [&](Id entry) { return key(entry) == sought; });
  if (found != HashIndex::kNone) return found;
  const auto first = static_cast<std::uint32_t>(keys.size());
  GROVE_ASSERT(first == keys.size(), "the key offsets fit into 32 bits");
  index.reserve_one();
  entries.push_back({first, {}});
  try {
    keys += sought;
  } catch (...) {
    entries.pop_back();
    throw;
  }
  const Id added = index.add(hash);
  GROVE_ASSERT(static_cast<std::size_t>(added) + 1 == entries.size(),
               "the index numbers the entries in their order");
  return added;
}

std::string_view SubproblemTable::Part::key(Id entry) const {
  const auto at = static_cast<std::size_t>(entry);
  const std::size_t end = at + 1 < entries.size() ? entries[at + 1].first : keys.size();
  return std::string_view(keys).substr(entries[at].first, end - entries[at].first);
}

std::size_t SubproblemTable::Part::bytes() const {
  return entries.capacity() * sizeof(Entry) + keys.capacity() + index.bytes();
}

}  // namespace grove::detail
