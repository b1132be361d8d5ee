// SPDX-License-Identifier: MIT
// Joint task sequences - one per agent - from the cheapest on (paper, Algorithm 3), as far as
// asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/instance.h"
#include "model/omega.h"
#include "sequencing/k_best_sequences.h"

namespace grove::detail {

struct JointSequence {
  Cost cost = 0;                     // sum of the agents' sequence costs
  std::vector<std::uint32_t> ranks;  // by AgentIndex: which of its K-best sequences
};

// Every combination of the agents' lists exactly once, by cost. Not for two threads at once.
class KBestJointSequences {
 public:
  // `limits` must outlive it, like what the lists refer to.
  KBestJointSequences(std::vector<KBestSequences> agents, const Limits& limits);
  ~KBestJointSequences();
  KBestJointSequences(KBestJointSequences&&) noexcept;

  // A proven lower bound on the cost of the next joint sequence, without new work; kInfiniteCost
  // when there is proven to be none. Never decreases.
  Cost lower_bound() const;
  // The next best joint sequence; none when all were returned (lower_bound() is then kInfiniteCost)
  // or when a limit struck.
  std::optional<JointSequence> next();

  // One agent's sequence of a rank that next() has returned.
  const Sequence& sequence(AgentIndex agent, std::uint32_t rank);

  // rTSPs solved so far, over all agents.
  std::int64_t rtsp_calls() const;

 private:
  class Queue;
  std::unique_ptr<Queue> queue_;
};

}  // namespace grove::detail
