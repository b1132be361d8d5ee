// SPDX-License-Identifier: MIT
// Conflicts are looked for in order of time, so a search that wants only the first pays only for
// the steps before it. Two arrays hold who is where now and one step ago; entries carry a stamp
// that grows for ever, so nothing is ever cleared. Up to the first vertex conflict no cell holds
// two agents, which is why one entry per cell is enough to see every swap in that step.
#include "grove/conflicts/conflict.h"

#include <algorithm>

namespace grove {
namespace {

Cell position_at(const Path& path, Time time) {
  return time < static_cast<Time>(path.size()) ? path[time] : path.back();
}

}  // namespace

std::array<AgentConstraint, 2> split(const Conflict& c) {
  if (!c.is_swap()) {
    const Constraint here{c.cell, kNoCell, c.time, c.time};
    return {{{c.first, here}, {c.second, here}}};
  }
  return {
      {{c.first, {c.cell, c.from, c.time, c.time}}, {c.second, {c.from, c.cell, c.time, c.time}}}};
}

ConflictFinder::ConflictFinder(const Grid& grid, std::uint64_t seed) : seed_(seed) {
  for (auto& visits : visits_) visits.resize(grid.cell_count());
}

std::optional<Conflict> ConflictFinder::first(std::span<const Path> paths) {
  std::size_t horizon = 0;
  for (const Path& path : paths) horizon = std::max(horizon, path.size());
  std::optional<Conflict> best;
  for (Time time = 0; time < static_cast<Time>(horizon) && !best; ++time) {
    visit_all(paths, time, best);
    if (time > 0) find_swaps(paths, time, best);
  }
  base_ += static_cast<std::int64_t>(horizon) + 1;
  return best;
}

void ConflictFinder::visit_all(std::span<const Path> paths, Time time,
                               std::optional<Conflict>& best) {
  auto& now = visits_[time % 2];
  for (AgentIndex agent = 0; agent < static_cast<AgentIndex>(paths.size()); ++agent) {
    const Cell cell = position_at(paths[agent], time);
    Visit& visit = now[cell];
    if (visit.stamp == base_ + time)
      consider({visit.agent, agent, cell, kNoCell, time}, best);
    else
      visit = {base_ + time, agent};
  }
}

void ConflictFinder::find_swaps(std::span<const Path> paths, Time time,
                                std::optional<Conflict>& best) const {
  const auto& before = visits_[(time - 1) % 2];
  for (AgentIndex agent = 0; agent < static_cast<AgentIndex>(paths.size()); ++agent) {
    const Cell to = position_at(paths[agent], time);
    const Cell from = position_at(paths[agent], time - 1);
    const Visit& other = before[to];
    if (from == to || other.stamp != base_ + time - 1 || other.agent <= agent) continue;
    if (position_at(paths[other.agent], time) == from)
      consider({agent, other.agent, to, from, time}, best);
  }
}

void ConflictFinder::consider(const Conflict& conflict, std::optional<Conflict>& best) const {
  if (!best || priority(conflict) < priority(*best)) best = conflict;
}

// A hash of the pair (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t ConflictFinder::priority(const Conflict& conflict) const {
  std::uint64_t x = seed_ * 0x9e3779b97f4a7c15 +
                    (static_cast<std::uint64_t>(conflict.first) << 32) +
                    static_cast<std::uint64_t>(conflict.second);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace grove
