// SPDX-License-Identifier: MIT
// Forest for policy `fixed`: one tree per joint task sequence, in order of cost (paper, Algorithms
// 1 and 4).
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "model/limits.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/fixed_order_sipp.h"
#include "search/forest.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/k_best_joint_sequences.h"

namespace grove::detail {

// Instantiates one tree per joint task sequence, least cost first.
class SequenceForest : public Forest {
 public:
  // `problem`, `limits` and `pool` must outlive the forest; `pool` holds the nodes of its trees.
  // The constructor computes the cost matrices; tables and sequences are computed on first use.
  // Throws std::invalid_argument if `backend` is not built.
  SequenceForest(const Problem& problem, NodePool& pool, RtspBackend backend, const Limits& limits);

  Cost next_bound() const override;
  NodePtr next_root() override;
  std::int64_t rtsp_calls() const override { return sequences_.rtsp_calls(); }

 private:
  std::shared_ptr<const AgentSequencing>& slot(AgentIndex agent, std::uint32_t rank);
  bool plan_missing_orders(const JointSequence& joint);
  bool plan_order(AgentIndex agent, std::uint32_t rank);
  void avoid(AgentIndex agent, const PackedSteps& path);

  const Problem& problem_;
  NodePool& pool_;
  const Limits& limits_;
  std::vector<CostMatrix> matrices_;
  KBestJointSequences sequences_;
  std::optional<JointSequence> pending_;  // taken from sequences_, not yet instantiated
  std::vector<std::vector<std::shared_ptr<const AgentSequencing>>> orders_;  // by agent, then rank
  FixedOrderSipp low_level_;
  ConflictAvoidanceTable others_;
  Path path_;
  std::deque<Tree> trees_;
  std::uint32_t count_ = 0;  // number of instantiated trees
};

}  // namespace grove::detail
