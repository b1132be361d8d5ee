// SPDX-License-Identifier: MIT
// What a few agents cost more together under the demands of a node, by joint search.
#pragma once

#include <cstdint>
#include <span>

#include "model/limits.h"
#include "model/tuning.h"
#include "search/dependency_table.h"
#include "search/node_view.h"
#include "search/path_planner.h"

namespace grove::detail {

// A* over the joint states of a group, where splitting its conflicts does not end. The essay is at
// the head of joint_groups.cpp. Of one thread.
class JointGroups {
 public:
  using Known = DependencyTable::Known;

  // All must outlive this; `planner` may be shared with others of the same thread.
  JointGroups(const Instance& instance, const Tuning& tuning, PathPlanner& planner)
      : instance_(instance), tuning_(tuning), planner_(planner) {}

  // Raises what is known of agents in the scope of `view`, in ascending order: by how much they
  // cost more together, under what its node demands of them, than their paths there. Plans in which
  // that is more than `slack` are of no interest. False: a limit struck.
  bool settle(const NodeView& view, std::span<const AgentIndex> group, Cost slack,
              const Limits& limits, Known& known);

  // Joint states looked at so far; and what all has cost, in the unit of search/work.h.
  std::int64_t states() const { return states_; }
  std::int64_t work() const;

 private:
  enum class Outcome : std::uint8_t { kSettled, kGivenUp, kStopped };
  Outcome settle_up_to(Cost most, const NodeView& view, std::span<const AgentIndex> group,
                       const Limits& limits, Known& known);

  const Instance& instance_;
  const Tuning& tuning_;
  PathPlanner& planner_;
  std::int64_t states_ = 0;
  std::int64_t joint_work_ = 0;
  std::int64_t give_up_at_ = 0;  // of work()
};

}  // namespace grove::detail
