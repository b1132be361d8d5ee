// SPDX-License-Identifier: MIT
// By when two agents cannot both have finished.
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

// Which agent by when, and which other.
struct FinishTimeConflict {
  AgentIndex a = -1;
  AgentIndex b = -1;
  Time finish_a = 0;
  Time finish_b = 0;
};

// Compares the sets of all paths of two agents that cost so much. Remembers what it found. For one
// thread at a time.
class FinishTimeConflicts {
 public:
  // Effort on one set and on one comparison; and what all sets may hold.
  struct Most {
    std::size_t set_nodes;
    std::size_t compared_pairs;
    std::size_t bytes;
  };

  // All must outlive this.
  FinishTimeConflicts(const World& world, AgentStopsCache& stops, Most most);
  ~FinishTimeConflicts();

  // Proven: no two paths without a collision finish by these times. Not found out: false.
  bool are_incompatible(const FinishTimeConflict& pair, const Limits& limits);
  // Later times of which that is so, too: none of the two can be a step later.
  FinishTimeConflict extended(FinishTimeConflict pair, const Limits& limits);

  // Nodes of sets and pairs of them looked at so far.
  std::int64_t work() const { return builder_.nodes() + dependency_.pairs(); }

 private:
  enum class Known : std::uint8_t { kNot, kExcluded, kNotExcluded };  // 0 first: see Grid
  struct OfAgent {
    std::unique_ptr<SequenceStages> goals;
    Time least = 0;  // it cannot finish before
    // By how much later; null: too large. Empty: none finishes exactly then.
    std::vector<std::unique_ptr<Mdd>> sets;
  };

  static constexpr Time kGrid = 16;  // steps later than the least that are looked at
  using Grid = std::array<Known, kGrid * kGrid>;

  Known compared(const FinishTimeConflict& pair, Time later_a, Time later_b, const Limits& limits);
  const Mdd* set(AgentIndex agent, Time later, const Limits& limits);
  OfAgent& of(AgentIndex agent, const Limits& limits);

  const World& world_;
  AgentStopsCache& stops_;
  const Most most_;
  MddBuilder builder_;
  JointMddSearch dependency_;
  std::vector<OfAgent> agents_;
  std::unordered_map<std::uint64_t, Grid> known_;  // by pair
  std::size_t bytes_ = 0;
};

}  // namespace grove::detail
