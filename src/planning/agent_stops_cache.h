// SPDX-License-Identifier: MIT
// Cache of the AgentStops of all agents, for planning the agents one after the other.
#pragma once

#include <memory>
#include <vector>

#include "planning/agent_prices.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Stores the AgentStops of each agent, with its costs to go, from the first request on. Tables for
// many tasks are large, so all searches of one thread should share one cache. One thread at a time.
class AgentStopsCache {
 public:
  // All arguments must outlive this object. `prices`: nullptr if the agents have none.
  AgentStopsCache(const Instance& instance, const DistanceFields& distances,
                  const Prices* prices = nullptr)
      : instance_(instance),
        distances_(distances),
        prices_(prices),
        stops_(instance.agent_count()) {}

  // Copy for another thread. Shares the data that `other` has computed so far.
  AgentStopsCache(const AgentStopsCache& other)
      : instance_(other.instance_),
        distances_(other.distances_),
        prices_(other.prices_),
        stops_(other.stops_.size()) {
    for (std::size_t agent = 0; agent < stops_.size(); ++agent)
      if (other.stops_[agent]) {
        stops_[agent] = std::make_unique<AgentStops>(*other.stops_[agent]);
        stops_[agent]->cost_to_go().mark();
      }
  }

  AgentStops& of(AgentIndex agent) {
    auto& stops = stops_[agent];
    if (!stops && prices_ && prices_->agents[agent])
      stops = std::make_unique<AgentStops>(instance_, distances_, agent, *prices_->agents[agent]);
    else if (!stops)
      stops = std::make_unique<AgentStops>(instance_, distances_, agent);
    return *stops;
  }

 private:
  const Instance& instance_;
  const DistanceFields& distances_;
  const Prices* prices_;
  std::vector<std::unique_ptr<AgentStops>> stops_;  // by AgentIndex
};

}  // namespace grove::detail
