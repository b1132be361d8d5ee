// SPDX-License-Identifier: MIT
// Two arrays hold who is where now and one step ago, as a list per place; entries carry a stamp
// that grows for ever, so nothing is ever cleared.
#include "grove/detail/conflicts/conflict.h"

#include <algorithm>

#include "grove/detail/model/assert.h"

namespace grove::detail {

Split split(const Conflict& c) {
  GROVE_ASSERT(c.first >= 0 && c.first < c.second, "two agents conflict");
  if (c.is_following()) {
    // Whoever leaves may not have been there just before, or the other not enter then.
    const auto bar = [&](AgentIndex agent) {
      const Time time = agent == c.follower ? c.time : c.time - 1;
      return Constraint{c.cell, kNoPlace, time, time};
    };
    return {{{c.first, bar(c.first)}, {c.second, bar(c.second)}}};
  }
  if (!c.is_swap()) {
    const Constraint here{c.cell, kNoPlace, c.time, c.time};
    return {{{c.first, here}, {c.second, here}}};
  }
  return {
      {{c.first, {c.cell, c.from, c.time, c.time}}, {c.second, {c.from, c.cell, c.time, c.time}}}};
}

ConflictFinder::ConflictFinder(const World& world, bool may_follow)
    : world_(world), may_follow_(may_follow) {
  for (auto& visits : visits_) visits.resize(world.place_count());
}

void ConflictFinder::all(std::span<const Path> paths, std::span<const AgentIndex> agents,
                         std::vector<Conflict>& conflicts) {
  conflicts.clear();
  std::size_t horizon = 0;
  for (AgentIndex agent : agents) horizon = std::max(horizon, paths[agent].size());
  for (auto& list : also_there_) list.resize(std::max(list.size(), paths.size()));
  for (Time time = 0; time < static_cast<Time>(horizon); ++time) {
    for (AgentIndex agent : agents) meet_all(paths, agent, time, conflicts);
    if (time == 0) continue;
    for (AgentIndex agent : agents) swap_all(paths, agent, time, conflicts);
    if (may_follow_) continue;
    for (AgentIndex agent : agents) follow_all(paths, agent, time, conflicts);
  }
  base_ += static_cast<std::int64_t>(horizon) + 1;
}

// Puts the agent where it is, and reports whom it meets there.
void ConflictFinder::meet_all(std::span<const Path> paths, AgentIndex agent, Time time,
                              std::vector<Conflict>& conflicts) {
  const Place place = place_at(world_, paths[agent], time);
  Visit& visit = visits_[time % 2][place];
  auto& also_there = also_there_[time % 2];
  also_there[agent] = visit.stamp == base_ + time ? visit.agent : -1;
  visit = {base_ + time, agent};
  for (AgentIndex other = also_there[agent]; other >= 0; other = also_there[other]) {
    const bool together = time > 0 && place_at(world_, paths[agent], time - 1) == place &&
                          place_at(world_, paths[other], time - 1) == place;
    if (!together)
      conflicts.push_back({std::min(agent, other), std::max(agent, other), place, kNoPlace, time});
  }
}

void ConflictFinder::swap_all(std::span<const Path> paths, AgentIndex agent, Time time,
                              std::vector<Conflict>& conflicts) const {
  const Place to = place_at(world_, paths[agent], time);
  const Place from = place_at(world_, paths[agent], time - 1);
  const Visit& visit = visits_[(time - 1) % 2][to];
  if (from == to || visit.stamp != base_ + time - 1) return;
  const auto& also_there = also_there_[(time - 1) % 2];
  for (AgentIndex other = visit.agent; other >= 0; other = also_there[other])
    if (agent < other && place_at(world_, paths[other], time) == from)
      conflicts.push_back({agent, other, to, from, time});
}

// Those that stay are met, those that come the other way swapped with.
void ConflictFinder::follow_all(std::span<const Path> paths, AgentIndex agent, Time time,
                                std::vector<Conflict>& conflicts) const {
  const Place to = place_at(world_, paths[agent], time);
  const Place from = place_at(world_, paths[agent], time - 1);
  const Visit& visit = visits_[(time - 1) % 2][to];
  if (from == to || visit.stamp != base_ + time - 1) return;
  const auto& also_there = also_there_[(time - 1) % 2];
  for (AgentIndex other = visit.agent; other >= 0; other = also_there[other]) {
    const Place now = place_at(world_, paths[other], time);
    if (now != to && now != from)
      conflicts.push_back(
          {std::min(agent, other), std::max(agent, other), to, kNoPlace, time, agent});
  }
}

}  // namespace grove::detail
