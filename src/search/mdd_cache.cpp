// SPDX-License-Identifier: MIT
#include "search/mdd_cache.h"

#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kBytesPerEntry = 80;  // approximate: hash table entry and shared_ptr

std::size_t bytes_of(const MddCache::Set& set) {
  return kBytesPerEntry + set->bytes();
}

}  // namespace

MddCache::Set MddCache::find(SubproblemTable::Id id) const {
  return parts_.with(parts_.part_of(id), [&](const Part& part) {
    for (const Sets* sets : {&part.young, &part.old})
      if (const auto found = sets->find(id); found != sets->end()) return found->second;
    return Set();
  });
}

void MddCache::add(SubproblemTable::Id id, const Set& set) {
  parts_.with(parts_.part_of(id), [&](Part& part) {
    if (!part.young.try_emplace(id, set).second) return;
    const std::size_t bytes = bytes_of(set);
    part.young_bytes += bytes;
    young_bytes_ += bytes;
    if (part.old.erase(id) == 0)
      bytes_ += bytes;
    else
      part.old_bytes -= bytes;
  });
}

MddCache::Set MddCache::make(PathPlanner& planner, AgentIndex agent, const AgentSequencing& order,
                             std::span<const Constraint> constraints, Time cost,
                             std::size_t max_nodes, const Limits& limits) {
  Mdd paths;
  const auto outcome = planner.mdd(agent, order, constraints, cost, max_nodes, limits, paths);
  if (outcome == MddBuilder::Outcome::kStopped) return nullptr;
  return std::make_shared<const Mdd>(std::move(paths));
}

void MddCache::trim() {
  if (young_bytes_ < max_young_bytes_ || trimming_.exchange(true)) return;
  for (std::size_t number = 0; number < Sharded<Part>::kParts; ++number) {
    const Sets forgotten = parts_.with(number, [&](Part& part) {
      bytes_ -= std::exchange(part.old_bytes, part.young_bytes);
      young_bytes_ -= std::exchange(part.young_bytes, 0);
      return std::exchange(part.old, std::exchange(part.young, {}));
    });
  }
  trimming_ = false;
}

}  // namespace grove::detail
