// SPDX-License-Identifier: MIT
// The low level of CBS when it chooses the order of the tasks itself.
#pragma once

#include <cstdint>
#include <memory>

#include "planning/agent_planner.h"

namespace grove::detail {

// Safe-interval path planning with one label per (cell, safe interval, state), a state being what
// is left to visit. The essay with the proof is at the head of free_low_level_search.cpp. Heeds all
// of a query.
class FreeOrderSipp : public AgentPlanner {
 public:
  // `world` must outlive this.
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
