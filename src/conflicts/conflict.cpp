// SPDX-License-Identifier: MIT
// Two arrays hold the moving agents by place, as linked lists: one for the current time and one for
// the previous time. A third array holds the agents that have come to rest, which are entered only
// once. Entries carry a stamp that never decreases, so the arrays are never cleared.
#include "conflicts/conflict.h"

#include <algorithm>
#include <functional>

#include "model/assert.h"

namespace grove::detail {

Split split(const Conflict& c) {
  GROVE_ASSERT(c.first >= 0 && c.first < c.second,
               "a conflict has two agents, the smaller index first");
  if (c.is_following()) {
    // Either the leading agent is not on the place one step before the conflict, or the follower is
    // not on it at the time of the conflict.
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
  rests_.resize(world.place_count());
}

void ConflictFinder::all(std::span<const Path> paths, std::span<const AgentIndex> agents,
                         std::vector<Conflict>& conflicts) {
  conflicts.clear();
  GROVE_ASSERT(std::ranges::adjacent_find(agents, std::greater_equal<>()) == agents.end(),
               "agents are in ascending order, each once");
  begin(paths, agents);
  Time time = 0;
  for (; !moving_.empty(); ++time) {
    step(paths, time);
    find_vertex_conflicts(time, conflicts);
    if (time == 0) continue;
    for (const AgentIndex agent : moving_) find_edge_conflicts(agent, time, conflicts);
    if (may_follow_) continue;
    for (const AgentIndex agent : moving_) find_following_conflicts(agent, time, conflicts);
  }
  base_ += time + 1;
  GROVE_ASSERT(std::ranges::is_sorted(conflicts, {}, &Conflict::time),
               "conflicts are in order of time");
}

void ConflictFinder::begin(std::span<const Path> paths, std::span<const AgentIndex> agents) {
  moving_.assign(agents.begin(), agents.end());
  for (auto* by_agent : {&also_there_[0], &also_there_[1], &also_rests_})
    by_agent->resize(std::max(by_agent->size(), paths.size()));
  for (auto* by_agent : {&now_, &before_})
    by_agent->resize(std::max(by_agent->size(), paths.size()));
}

// Moves all agents to `time`. An agent whose path has ended rests from then on.
void ConflictFinder::step(std::span<const Path> paths, Time time) {
  const auto rests = [&](AgentIndex agent) {
    if (time < static_cast<Time>(paths[agent].size())) return false;
    Visit& rest = rests_[now_[agent]];
    also_rests_[agent] = rest.stamp == base_ ? rest.agent : -1;
    rest = {base_, agent};
    return true;
  };
  std::erase_if(moving_, rests);
  for (const AgentIndex agent : moving_) {
    before_[agent] = now_[agent];
    now_[agent] = world_.place(paths[agent][time]);
  }
}

// Reports all vertex conflicts at `time`, sorted by `second` ascending, then `first` descending.
void ConflictFinder::find_vertex_conflicts(Time time, std::vector<Conflict>& conflicts) {
  const auto first = std::ssize(conflicts);
  for (const AgentIndex agent : moving_) add_vertex_conflicts(agent, time, conflicts);
  if (std::ssize(conflicts) - first < 2) return;
  std::sort(conflicts.begin() + first, conflicts.end(), [](const Conflict& c, const Conflict& d) {
    return c.second != d.second ? c.second < d.second : c.first > d.first;
  });
  GROVE_ASSERT(std::adjacent_find(conflicts.begin() + first, conflicts.end(),
                                  [](const Conflict& c, const Conflict& d) {
                                    return c.first == d.first && c.second == d.second;
                                  }) == conflicts.end(),
               "two agents have one vertex conflict at a time");
}

// Enters the agent at its place and reports its new vertex conflicts with agents entered before it
// and with resting agents.
void ConflictFinder::add_vertex_conflicts(AgentIndex agent, Time time,
                                          std::vector<Conflict>& conflicts) {
  const Place place = now_[agent];
  Visit& visit = visits_[time % 2][place];
  auto& also_there = also_there_[time % 2];
  also_there[agent] = visit.stamp == base_ + time ? visit.agent : -1;
  visit = {base_ + time, agent};
  const bool was_there = time > 0 && before_[agent] == place;
  const auto report = [&](AgentIndex other) {
    GROVE_ASSERT(other != agent && now_[other] == place,
                 "two agents with a vertex conflict are on the same place");
    conflicts.push_back({std::min(agent, other), std::max(agent, other), place, kNoPlace, time});
  };
  for (AgentIndex other = also_there[agent]; other >= 0; other = also_there[other])
    if (!was_there || before_[other] != place) report(other);
  if (was_there || rests_[place].stamp != base_) return;
  for (AgentIndex other = rests_[place].agent; other >= 0; other = also_rests_[other])
    report(other);
}

// Reports the swaps of `agent` with agents of greater index. A resting agent swaps with no other.
void ConflictFinder::find_edge_conflicts(AgentIndex agent, Time time,
                                         std::vector<Conflict>& conflicts) const {
  const Place to = now_[agent];
  const Place from = before_[agent];
  const Visit& visit = visits_[(time - 1) % 2][to];
  if (from == to || visit.stamp != base_ + time - 1) return;
  const auto& also_there = also_there_[(time - 1) % 2];
  for (AgentIndex other = visit.agent; other >= 0; other = also_there[other])
    if (agent < other && now_[other] == from) {
      GROVE_ASSERT(before_[other] == to, "two agents with an edge conflict swap places");
      conflicts.push_back({agent, other, to, from, time});
    }
}

// Reports the following conflicts in which `agent` enters a place. Skips an agent that stays on the
// place (a vertex conflict) and an agent that moves the opposite way (a swap).
void ConflictFinder::find_following_conflicts(AgentIndex agent, Time time,
                                              std::vector<Conflict>& conflicts) const {
  const Place to = now_[agent];
  const Place from = before_[agent];
  const Visit& visit = visits_[(time - 1) % 2][to];
  if (from == to || visit.stamp != base_ + time - 1) return;
  const auto& also_there = also_there_[(time - 1) % 2];
  for (AgentIndex other = visit.agent; other >= 0; other = also_there[other])
    if (now_[other] != to && now_[other] != from) {
      GROVE_ASSERT(other != agent && before_[other] == to,
                   "a following agent enters the place that the other agent leaves");
      conflicts.push_back(
          {std::min(agent, other), std::max(agent, other), to, kNoPlace, time, agent});
    }
}

}  // namespace grove::detail
