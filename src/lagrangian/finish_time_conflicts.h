// SPDX-License-Identifier: MIT
// Proves that two agents cannot both finish by given times in any plan.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "model/limits.h"
#include "planning/agent_stops_cache.h"
#include "planning/joint_mdd_search.h"
#include "planning/mdd.h"

namespace grove::detail {

// The event that agent `a` finishes at time `finish_a` or earlier, and agent `b` at `finish_b` or
// earlier.
struct FinishTimePair {
  AgentIndex a = -1;
  AgentIndex b = -1;
  Time finish_a = 0;
  Time finish_b = 0;
};

// Tests such events by a joint search over the MDDs of the two agents, and caches the results.
// Proof: finish_time_conflicts.cpp. One thread at a time.
class FinishTimeConflicts {
 public:
  // Limits: number of nodes of an MDD, number of node pairs of a joint search, and total size of
  // all MDDs in bytes.
  struct MaxSizes {
    std::size_t mdd_nodes;
    std::size_t joint_mdd_nodes;
    std::size_t bytes;
  };

  // `world` and `stops` must outlive this object.
  FinishTimeConflicts(const World& world, AgentStopsCache& stops, MaxSizes max_sizes);
  ~FinishTimeConflicts();

  // Returns true if it is proven that any two paths that finish by these times collide. Returns
  // false if this is not proven, for example because a limit was reached.
  bool are_incompatible(const FinishTimePair& pair, const Limits& limits);
  // Raises the finish times of an incompatible pair, one step at a time, as long as
  // are_incompatible() remains true. Afterwards are_incompatible() is false if either time is one
  // step later.
  FinishTimePair extended(FinishTimePair pair, const Limits& limits);

  // Effort so far: the number of MDD nodes built, plus the number of node pairs examined.
  std::int64_t work() const { return builder_.nodes() + dependency_.pairs(); }

 private:
  enum class Verdict : std::uint8_t { kUnknown, kExcluded, kNotExcluded };  // new entries: kUnknown
  struct OfAgent {
    std::unique_ptr<SequenceStages> goals;
    Time earliest = 0;  // a lower bound on the finish time
    // By finish time minus `earliest`: the MDD; nullptr if it could not be built within the limits;
    // empty if no path finishes exactly at that time.
    std::vector<std::unique_ptr<Mdd>> mdds;
  };

  static constexpr Time kGrid =
      16;  // number of finish times examined per agent, from `earliest` on
  using Grid = std::array<Verdict, kGrid * kGrid>;

  Verdict compared(const FinishTimePair& pair, Time later_a, Time later_b, const Limits& limits);
  const Mdd* mdd(AgentIndex agent, Time later, const Limits& limits);
  OfAgent& of(AgentIndex agent, const Limits& limits);

  const World& world_;
  AgentStopsCache& stops_;
  const MaxSizes max_sizes_;
  MddBuilder builder_;
  JointMddSearch dependency_;
  std::vector<OfAgent> agents_;
  std::unordered_map<std::uint64_t, Grid> known_;  // by pair of agents
  std::size_t bytes_ = 0;
};

}  // namespace grove::detail
