// SPDX-License-Identifier: MIT
// Low level of CBS that chooses the order of the tasks together with the path.
#pragma once

#include <cstdint>
#include <memory>

#include "planning/agent_planner.h"

namespace grove::detail {

// Safe-interval path planning with one label per (state, safe interval, stage), where the stage is
// the set of stops left to visit. The proof is at the head of free_order_sipp.cpp. Supports every
// field of a PathQuery.
class FreeOrderSipp : public AgentPlanner {
 public:
  // `world` must outlive this object.
  explicit FreeOrderSipp(const World& world);
  ~FreeOrderSipp() override;

  PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                   Path& path) override;
  std::int64_t expanded() const override;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove::detail
