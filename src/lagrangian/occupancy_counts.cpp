// SPDX-License-Identifier: MIT
#include "lagrangian/occupancy_counts.h"

#include <algorithm>
#include <unordered_map>

namespace grove::detail {

void OccupancyCounts::count(std::span<const Path> paths) {
  paths_ = paths;
  end_ = 1;
  for (const Path& path : paths) end_ = std::max(end_, static_cast<Time>(path.size()));
  counts_.assign(static_cast<std::size_t>(end_) * static_cast<std::size_t>(world_.place_count()),
                 0);
  for (const Path& path : paths) {
    if (path.empty()) continue;
    for (Time time = 0; time < end_; ++time) ++counts_[index(place_at(world_, path, time), time)];
  }
}

std::vector<Collision> OccupancyCounts::collisions() const {
  std::vector<Collision> found;
  std::unordered_map<std::uint64_t, AgentIndex> met;  // by move: agent for the next collision
  const auto move = [&](Place from, Place to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
  };
  for (Time time = 1; time < end_; ++time) {
    met.clear();
    for (AgentIndex agent = 0; agent < std::ssize(paths_); ++agent) {
      if (paths_[agent].empty()) continue;
      const Place from = place_at(world_, paths_[agent], time - 1);
      const Place to = place_at(world_, paths_[agent], time);
      if (at(to, time) > 1) {
        const auto [there, is_first] = met.try_emplace(move(to, to), agent);
        if (!is_first) {
          found.push_back({there->second, agent, time, to, kNoPlace});
          there->second = agent;
        }
      }
      if (from == to || at(to, time - 1) == 0 || at(from, time) == 0) continue;
      met.try_emplace(move(from, to), agent);
      if (const auto other = met.find(move(to, from)); other != met.end())
        found.push_back({other->second, agent, time, from, to});
    }
  }
  return found;
}

}  // namespace grove::detail
