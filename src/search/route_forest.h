// SPDX-License-Identifier: MIT
// Forest for policy `fixed` and instances with choices: one tree per joint route, in order of cost.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "assignment/instance_routes.h"
#include "model/limits.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/fixed_order_sipp.h"
#include "search/forest.h"
#include "sequencing/k_best_joint_routes.h"

namespace grove::detail {

// Instantiates one tree per joint assignment of tasks and goals with sequences, least cost first:
// the forest of the paper (SequenceForest), where the joint sequences come from a problem that also
// assigns, as in CBS-TA (Hoenig et al. 2018) and CBS-TS.
class RouteForest : public Forest {
 public:
  // `problem`, `limits` and `pool` must outlive the forest; `pool` holds the nodes of its trees.
  // Throws InstanceError for the instances that require_joint_routes() refuses, and
  // std::invalid_argument if `backend` is not built.
  RouteForest(const Problem& problem, NodePool& pool, RtspBackend backend, const Limits& limits);

  Cost next_bound() const override;
  NodePtr next_root() override;
  std::int64_t rtsp_calls() const override { return joint_routes_.solver_calls(); }

 private:
  using Order = std::shared_ptr<const AgentSequencing>;

  std::optional<std::vector<Order>> orders_of(const JointRoute& joint);
  Order plan_order(AgentIndex agent, const AgentRoute& route);

  const Problem& problem_;
  NodePool& pool_;
  const Limits& limits_;
  const InstanceRoutes routes_;
  KBestJointRoutes joint_routes_;
  std::optional<JointRoute> pending_;  // taken from joint_routes_, not yet instantiated
  std::vector<std::map<AgentRoute, Order>> orders_;  // by AgentIndex
  FixedOrderSipp low_level_;
  ConflictAvoidanceTable others_;
  Path path_;
  std::deque<Tree> trees_;
};

}  // namespace grove::detail
