// SPDX-License-Identifier: MIT
// The stops of all agents, for those who plan one after the other.
#pragma once

#include <memory>
#include <vector>

#include "planning/sequence_stages.h"

namespace grove::detail {

// Each agent's AgentStops, made when first asked for and kept, with their completions: the tables
// of many tasks are large, so that the searches of one thread had better share them. For one
// thread.
class AgentStopsCache {
 public:
  // `instance` and `distances` must outlive this.
  AgentStopsCache(const Instance& instance, const DistanceFields& distances)
      : instance_(instance), distances_(distances), stops_(instance.agent_count()) {}

  // The same for another thread: shares what `other` knows by now.
  AgentStopsCache(const AgentStopsCache& other)
      : instance_(other.instance_), distances_(other.distances_), stops_(other.stops_.size()) {
    for (std::size_t agent = 0; agent < stops_.size(); ++agent)
      if (other.stops_[agent]) {
        stops_[agent] = std::make_unique<AgentStops>(*other.stops_[agent]);
        stops_[agent]->cost_to_go().mark();
      }
  }

  AgentStops& of(AgentIndex agent) {
    auto& stops = stops_[agent];
    if (!stops) stops = std::make_unique<AgentStops>(instance_, distances_, agent);
    return *stops;
  }

 private:
  const Instance& instance_;
  const DistanceFields& distances_;
  std::vector<std::unique_ptr<AgentStops>> stops_;  // by AgentIndex
};

}  // namespace grove::detail
