// SPDX-License-Identifier: MIT
// Excess of a small group of agents under the constraints of a node, by joint A*.
#pragma once

#include <cstdint>
#include <span>

#include "model/limits.h"
#include "model/tuning.h"
#include "search/dependency_table.h"
#include "search/node_view.h"
#include "search/path_planner.h"

namespace grove::detail {

// Bounds the excess of groups whose conflicts splits do not resolve, by A* over joint states. The
// proof is at the head of joint_groups.cpp. One thread at a time.
class JointGroups {
 public:
  using ExcessBound = DependencyTable::ExcessBound;

  // All arguments must outlive this object. `planner` may be shared with other objects of the same
  // thread.
  JointGroups(const Instance& instance, const Tuning& tuning, PathPlanner& planner)
      : instance_(instance), tuning_(tuning), planner_(planner) {}

  // Raises `known`, the excess of the agents `group` over their paths at the node of `view`, under
  // the constraints of that node. The agents are in the scope of `view` and in ascending order.
  // Ends when the excess is exact or above `slack`, or earlier at a limit of effort
  // (Tuning::joint_group_work) or size, with a valid bound. Does nothing for more than
  // Tuning::joint_group_agents agents. Returns false if a limit of the run was reached.
  bool solve(const NodeView& view, std::span<const AgentIndex> group, Cost slack,
             const Limits& limits, ExcessBound& known);

  // Joint states expanded so far, and the effort of all calls, including all time-expanded graphs
  // of the planner, in the unit of model/effort.h.
  std::int64_t states() const { return states_; }
  std::int64_t work() const;

 private:
  enum class Outcome : std::uint8_t { kSolved, kAborted, kStopped };
  Outcome solve_up_to(Cost max_excess, const NodeView& view, std::span<const AgentIndex> group,
                      const Limits& limits, ExcessBound& known);

  const Instance& instance_;
  const Tuning& tuning_;
  PathPlanner& planner_;
  std::int64_t states_ = 0;
  std::int64_t joint_work_ = 0;
  std::int64_t abort_at_ = 0;  // value of work() at which to abort
};

}  // namespace grove::detail
