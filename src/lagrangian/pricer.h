// SPDX-License-Identifier: MIT
// Pricing: the subproblem values of several agents under given multipliers. With the messages that
// ask another process for them.
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

// Consecutive agents first .. end - 1 and their results, one entry per agent.
struct PricingJob {
  AgentIndex first = 0;
  AgentIndex end = 0;
  std::vector<ScaledCost> known;  // cost of a known path; kNoCost: none
  std::vector<ScaledCost> values;
  std::vector<Path> paths;  // empty: no path cheaper than `known` was found
  std::int64_t work = 0;    // in the unit of search/work.h
  bool failed = false;      // memory was refused: no result counts
};

// Messages between processes: the request for subproblem values of several agents, and the reply.
// Values.
struct PricingRequest {
  std::int64_t round = 0;
  std::int32_t first = 0;         // first agent
  std::vector<ScaledCost> known;  // as in PricingJob, from agent `first` on
  MultiplierUpdate update;        // changes of the multipliers since the helper's last request
};

struct PricingReply {
  std::int64_t round = 0;    // of the request
  std::uint64_t digest = 0;  // of the multipliers under which all values were computed
  std::int32_t first = 0;
  std::vector<ScaledCost> values;
  std::vector<Path> paths;  // empty: no path cheaper than the known one was found
  std::int64_t work = 0;
};

// Computes subproblem values. One thread at a time.
class Pricer {
 public:
  // `multipliers` must outlive this, and may change between jobs. `stops` is copied.
  Pricer(const Multipliers& multipliers, const AgentStopsCache& stops)
      : multipliers_(multipliers), stops_(stops), search_(multipliers.penalties()) {}

  // Computes the subproblem value of each agent of the job. Proven: no path of the agent has a
  // lower penalised cost.
  void perform(PricingJob& job, const Limits& limits);

 private:
  SequenceStages& goals(AgentIndex agent);
  ScaledCost first_value(AgentIndex agent, const Limits& limits, Path& path);
  ScaledCost price_below(ScaledCost below, AgentIndex agent, const Limits& limits, Path& path);

  const Multipliers& multipliers_;
  AgentStopsCache stops_;
  PenalizedSearch search_;
  std::vector<std::unique_ptr<SequenceStages>> goals_;  // by agent
};

}  // namespace grove::detail
