// SPDX-License-Identifier: MIT
// Paths of the agents planned so far, with their reservations; search for the agents that block a
// path.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "planning/reservation_table.h"

namespace grove::detail {

// Paths that do not collide with each other, by AgentIndex; empty for an agent without a path. One
// thread at a time.
class PlannedPaths {
 public:
  explicit PlannedPaths(const Instance& instance)
      : reservations_(instance.world(), instance.may_follow() ? 0 : 1),
        paths_(static_cast<std::size_t>(instance.agent_count())),
        versions_(paths_.size(), 0) {}

  const ReservationTable& reservations() const { return reservations_; }
  const std::vector<Path>& paths() const { return paths_; }
  const Path& path(AgentIndex agent) const { return paths_[agent]; }
  Time cost(AgentIndex agent) const { return static_cast<Time>(paths_[agent].size()) - 1; }
  // A number that changes whenever put() adds a path for the agent.
  std::int64_t version(AgentIndex agent) const { return versions_[agent]; }
  // Sum of the costs of all paths.
  Cost cost() const { return cost_; }

  // Adds a path. The agent must have none, and `path` must not collide with the other paths.
  void put(AgentIndex agent, Path path) {
    GROVE_ASSERT(paths_[agent].empty() && !path.empty(),
                 "an agent has at most one path, which is not empty");
    reservations_.add(agent, path);
    paths_[agent] = std::move(path);
    versions_[agent] = ++puts_;
    cost_ += cost(agent);
    steps_moved_ += static_cast<std::int64_t>(paths_[agent].size());
  }
  // Removes and returns the path of `agent`, which must have one.
  Path take(AgentIndex agent) {
    GROVE_ASSERT(!paths_[agent].empty(), "only an agent that has a path loses it");
    cost_ -= cost(agent);
    steps_moved_ += static_cast<std::int64_t>(paths_[agent].size());
    GROVE_ASSERT(cost_ >= 0, "the cost of the paths is not negative");
    reservations_.remove(agent, paths_[agent]);
    return std::exchange(paths_[agent], {});
  }
  void clear() {
    reservations_.clear();
    for (Path& path : paths_) path.clear();
    cost_ = 0;
  }

  // Total length of all paths put or taken so far: a measure of the effort of put() and take().
  std::int64_t steps_moved() const { return steps_moved_; }

 private:
  ReservationTable reservations_;
  std::vector<Path> paths_;
  std::vector<std::int64_t> versions_;
  std::int64_t puts_ = 0;
  Cost cost_ = 0;
  std::int64_t steps_moved_ = 0;
};

// Calls visit(other) for each planned agent `other` that would collide with `agent` if `agent` made
// each move of `path` `late` steps later and then rested. Collisions at the start of `path` before
// its first move are not reported. Can call visit() more than once for an agent. Stops when visit()
// returns false.
template <class Visit>
void for_each_blocking_agent(const World& world, const ReservationTable& reservations,
                             AgentIndex agent, const Path& path, Time late, Visit visit) {
  const auto ends_at = [&](AgentIndex other) {
    return other != ReservationTable::kNoAgent && other != agent && !visit(other);
  };
  const Time margin = reservations.margin();
  for (Time t = 1; t < static_cast<Time>(path.size()); ++t) {
    const Place from = world.place(path[t - 1]);
    const Place to = world.place(path[t]);
    for (Time at = t + late - margin; at <= t + late + margin; ++at)
      if (ends_at(reservations.agent_at(to, at))) return;
    const AgentIndex before = reservations.agent_at(to, t + late - 1);
    const bool swaps = from != to && before == reservations.agent_at(from, t + late);
    if (swaps && ends_at(before)) return;
  }
  const Time end = static_cast<Time>(path.size()) - 1 + late;
  for (const ReservationTable::Stay& stay : reservations.stays(world.place(path.back())))
    if (stay.last >= end - margin && ends_at(stay.agent)) return;
}

}  // namespace grove::detail
