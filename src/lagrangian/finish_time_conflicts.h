// SPDX-License-Identifier: MIT
// Pairs of finish times that two agents cannot both meet in any plan.
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

// Agent a finishes at finish_a or earlier, and agent b at finish_b or earlier.
struct FinishTimePair {
  AgentIndex a = -1;
  AgentIndex b = -1;
  Time finish_a = 0;
  Time finish_b = 0;
};

// Tests pairs of finish times by joint search of the MDDs of two agents, and caches the results.
// The proof is at the head of the .cpp. One thread at a time.
class FinishTimeConflicts {
 public:
  // Limits: nodes of one MDD, pairs of nodes of one joint search, bytes of all MDDs.
  struct MaxSizes {
    std::size_t mdd_nodes;
    std::size_t joint_mdd_nodes;
    std::size_t bytes;
  };

  // All references must outlive this.
  FinishTimeConflicts(const World& world, AgentStopsCache& stops, MaxSizes max_sizes);
  ~FinishTimeConflicts();

  // Returns true only if it is proven that no two paths without a collision finish by these times,
  // and false if it is not proven within the limits.
  bool are_incompatible(const FinishTimePair& pair, const Limits& limits);
  // Raises the finish times of an incompatible pair while it stays proven incompatible. Afterwards
  // neither can be a step later.
  FinishTimePair extended(FinishTimePair pair, const Limits& limits);

  // Nodes of MDDs and pairs of nodes examined so far.
  std::int64_t work() const { return builder_.nodes() + dependency_.pairs(); }

 private:
  enum class Verdict : std::uint8_t { kUnknown, kExcluded, kNotExcluded };  // 0 first: see Grid
  struct OfAgent {
    std::unique_ptr<SequenceStages> goals;
    Time earliest = 0;  // earliest finish, or a lower bound on it
    // MDDs by cost - least. nullptr: not built within the limits. Empty: no path finishes exactly
    // then.
    std::vector<std::unique_ptr<Mdd>> mdds;
  };

  static constexpr Time kGrid = 16;  // number of finish times examined, from least on
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
  std::unordered_map<std::uint64_t, Grid> known_;  // by pair
  std::size_t bytes_ = 0;
};

}  // namespace grove::detail
