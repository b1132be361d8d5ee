// SPDX-License-Identifier: MIT
// Conflicts between paths (docs/design.md, section 1; vertex and edge conflicts of CBS, Sharon et
// al. 2015).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail {

// A vertex conflict (two agents are on one place at the same time), an edge conflict (two agents
// swap places in one step) or, where following is forbidden (Instance::may_follow), a following
// conflict (an agent enters a place in the step in which another agent leaves it).
struct Conflict {
  AgentIndex first = -1;
  AgentIndex second = -1;
  Place cell = kNoPlace;  // the shared place; for a swap, the place that `first` arrives on; for a
                          // following conflict, the place that is entered and left
  Place from = kNoPlace;  // for a swap, the place that `first` leaves and `second` arrives on;
                          // else kNoPlace
  Time time = 0;          // for a swap or a following conflict, the time of arrival
  AgentIndex follower = -1;  // for a following conflict, the agent that enters `cell`; else -1

  bool is_swap() const { return from != kNoPlace; }
  bool is_following() const { return follower >= 0; }
};

// Two constraints such that every conflict-free plan satisfies at least one of them.
using Split = std::array<AgentConstraint, 2>;

// The standard CBS split: every pair of paths without this conflict satisfies at least one of the
// two constraints.
Split split(const Conflict& conflict);

// Finds conflicts among paths. Keeps its workspace between calls, so reuse it. One thread at a
// time.
class ConflictFinder {
 public:
  // `world` must outlive this object. `may_follow`: see Instance.
  explicit ConflictFinder(const World& world, bool may_follow = true);

  // Replaces `conflicts` by all conflicts among the paths of `agents` (ascending), in order of
  // time, each with `first` < `second`. `paths` is indexed by AgentIndex. If two agents stay on one
  // place together, only the first time counts. About O(agents * time + conflicts), if few agents
  // stay together on one place.
  void all(std::span<const Path> paths, std::span<const AgentIndex> agents,
           std::vector<Conflict>& conflicts);

 private:
  struct Visit {
    std::int64_t stamp = -1;  // base_ + time of the last visit; less than base_: earlier call
    AgentIndex agent = -1;
  };

  void begin(std::span<const Path> paths, std::span<const AgentIndex> agents);
  void step(std::span<const Path> paths, Time time);
  void find_vertex_conflicts(Time time, std::vector<Conflict>& conflicts);
  void add_vertex_conflicts(AgentIndex agent, Time time, std::vector<Conflict>& conflicts);
  void find_edge_conflicts(AgentIndex agent, Time time, std::vector<Conflict>& conflicts) const;
  void find_following_conflicts(AgentIndex agent, Time time,
                                std::vector<Conflict>& conflicts) const;

  const World& world_;
  const bool may_follow_;
  std::int64_t base_ = 0;
  std::vector<AgentIndex> moving_;   // agents whose paths have not ended, in ascending order
  std::vector<Place> now_, before_;  // places of the moving agents, by agent
  std::array<std::vector<Visit>, 2> visits_;  // of moving agents: by parity of time, then by place
  // Linked lists of the agents on one place: the next agent, by parity of time, then by agent; -1
  // ends the list.
  std::array<std::vector<AgentIndex>, 2> also_there_;
  std::vector<Visit> rests_;            // of resting agents, by place; the stamp is base_
  std::vector<AgentIndex> also_rests_;  // linked lists like also_there_
};

}  // namespace grove::detail
