// SPDX-License-Identifier: MIT
// K best joint task sequences, one sequence per agent (paper, Algorithm 3), computed lazily.
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

// One sequence for each agent.
struct JointSequence {
  Cost cost = 0;                     // sum of the agents' sequence costs
  std::vector<std::uint32_t> ranks;  // by AgentIndex: rank in the agent's KBestSequences
};

// Enumerates all combinations of the agents' sequences exactly once, in ascending order of cost.
// One thread at a time.
class KBestJointSequences {
 public:
  // `agents`: one list per agent, by AgentIndex. `limits`, and all objects to which `agents` refer,
  // must outlive this object.
  KBestJointSequences(std::vector<KBestSequences> agents, const Limits& limits);
  ~KBestJointSequences();
  KBestJointSequences(KBestJointSequences&&) noexcept;

  // Returns a proven lower bound on the cost of the next joint sequence, without further search.
  // kInfiniteCost: proven that none is left. Never decreases.
  Cost lower_bound() const;
  // Returns the next joint sequence in order of cost. Returns nullopt if all were returned
  // (lower_bound() is then kInfiniteCost), or if a limit was reached or a solver stopped
  // (RtspAnswer::kStopped).
  std::optional<JointSequence> next();

  // Returns the agent's sequence of this rank, which next() must have returned.
  const Sequence& sequence(AgentIndex agent, std::uint32_t rank);

  // Number of calls of rTSP solvers so far, over all agents.
  std::int64_t rtsp_calls() const;

 private:
  class Queue;
  std::unique_ptr<Queue> queue_;
};

}  // namespace grove::detail
