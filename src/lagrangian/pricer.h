// SPDX-License-Identifier: MIT
// The prices of agents under a tariff, some at one go.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lagrangian/multipliers.h"
#include "lagrangian/penalized_search.h"
#include "model/limits.h"
#include "planning/agent_stops_cache.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

constexpr std::int64_t kLabelsPerWork = 2;  // see search/work.h

// Agents in a row, and what became of them.
struct PricingJob {
  AgentIndex first = 0;
  AgentIndex end = 0;
  std::vector<ScaledCost> known;  // of a path each has, at least its price; kNoCost: it has none
  std::vector<ScaledCost> prices;
  std::vector<Path> paths;  // empty: there is none cheaper
  std::int64_t work = 0;    // in the unit of search/work.h
  bool failed = false;      // memory was refused: nothing of it counts
};

// What one thread prices agents with. Not of those that others have.
class Pricer {
 public:
  // `tariff` must outlive this, and may change between jobs.
  Pricer(const Multipliers& multipliers, const AgentStopsCache& stops)
      : multipliers_(multipliers), stops_(stops), search_(multipliers.penalties()) {}

  // Proven: under the tariff no path of an agent costs less than its price.
  void perform(PricingJob& job, const Limits& limits);

 private:
  SequenceStages& goals(AgentIndex agent);
  ScaledCost first_price(AgentIndex agent, const Limits& limits, Path& path);
  ScaledCost price_below(ScaledCost below, AgentIndex agent, const Limits& limits, Path& path);

  const Multipliers& multipliers_;
  AgentStopsCache stops_;
  PenalizedSearch search_;
  std::vector<std::unique_ptr<SequenceStages>> goals_;  // by agent
};

}  // namespace grove::detail
