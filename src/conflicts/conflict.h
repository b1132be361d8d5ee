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

// A vertex conflict: two agents are on one place at the same time. An edge conflict: they swap
// places in one step. Or, where it is forbidden (Instance::may_follow), a following conflict: an
// agent enters a place in the step in which the other leaves it.
struct Conflict {
  AgentIndex first = -1;
  AgentIndex second = -1;
  Place cell = kNoPlace;  // the shared place; for a swap, the place that `first` arrives on
  Place from = kNoPlace;  // kNoPlace: vertex conflict; else the place that `first` leaves and
                          // `second` arrives on
  Time time = 0;          // for a swap, the time of arrival
  AgentIndex follower =
      -1;  // of the two, the one that enters `cell` at `time`, following the other

  bool is_swap() const { return from != kNoPlace; }
  bool is_following() const { return follower >= 0; }
};

// Two constraints, at least one of which every conflict-free plan satisfies.
using Split = std::array<AgentConstraint, 2>;

// Standard CBS split: every pair of paths without this conflict satisfies at least one constraint.
Split split(const Conflict& conflict);

// Finds conflicts among paths. One thread at a time; reuse it.
class ConflictFinder {
 public:
  // `world` must outlive this. `may_follow`: see Instance.
  explicit ConflictFinder(const World& world, bool may_follow = true);

  // Replaces `conflicts` by all conflicts among the paths of `agents`, in order of time; `paths` is
  // by AgentIndex, and `first` < `second` in each. If two agents stay on one place together, only
  // the first time counts. O(agents * time + conflicts).
  void all(std::span<const Path> paths, std::span<const AgentIndex> agents,
           std::vector<Conflict>& conflicts);

 private:
  struct Visit {
    std::int64_t stamp = -1;  // base_ + time of the last visit; older stamps are of earlier calls
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
  std::vector<Place> now_, before_;  // their places, by agent
  std::array<std::vector<Visit>, 2> visits_;  // of moving agents: by parity of time, then by place
  // Linked list of the other agents there: by parity of time, then by agent; -1 ends the list.
  std::array<std::vector<AgentIndex>, 2> also_there_;
  std::vector<Visit> rests_;            // of resting agents, by place; the stamp is base_
  std::vector<AgentIndex> also_rests_;  // as also_there_
};

}  // namespace grove::detail
