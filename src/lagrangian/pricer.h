// SPDX-License-Identifier: MIT
// Pricing: computes the subproblem values of agents under given multipliers. Also defines the
// messages by which a process requests values from another one.
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

// The agents `first`, ..., `end` - 1, and their results with one entry per agent.
struct PricingJob {
  AgentIndex first = 0;
  AgentIndex end = 0;
  std::vector<ScaledCost> known;  // penalised cost of a known path; kNoCost: none
  std::vector<ScaledCost> values;
  std::vector<Path> paths;  // empty: no path cheaper than `known` was found
  std::int64_t work = 0;    // effort, in the unit of model/effort.h
  bool failed = false;      // memory ran out or a penalty was too great: the results are not valid
};

// Messages between processes: a request for the subproblem values of consecutive agents, and the
// reply. Value types.
struct PricingRequest {
  std::int64_t round = 0;
  std::int32_t first = 0;         // first agent
  std::vector<ScaledCost> known;  // as in PricingJob, from agent `first` on
  MultiplierUpdate update;        // changes of the multipliers since the helper's last request
};

struct PricingReply {
  std::int64_t round = 0;    // round of the request
  std::uint64_t digest = 0;  // digest of the multipliers under which all values were computed
  std::int32_t first = 0;
  std::vector<ScaledCost> values;
  std::vector<Path> paths;  // empty: no path cheaper than the known one was found
  std::int64_t work = 0;
};

// Computes subproblem values. Keeps the agents' cost-to-go stores between jobs. One thread at a
// time.
class Pricer {
 public:
  // `multipliers` must outlive this object, and may change between jobs. `stops` is copied.
  Pricer(const Multipliers& multipliers, const AgentStopsCache& stops)
      : multipliers_(multipliers), stops_(stops), search_(multipliers.penalties()) {}

  // Computes the subproblem value of each agent of the job, which is a proven lower bound on the
  // penalised cost of every path of the agent. It is exact unless a limit was reached (`limits`, or
  // the maximum number of labels or cost of a search).
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
