// SPDX-License-Identifier: MIT
// Shortest distances, ignoring other agents.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "grove/detail/model/assert.h"
#include "grove/detail/model/instance.h"
#include "grove/detail/model/limits.h"

namespace grove::detail {

// Distance in steps from every state to one of some states; kNever where none can be reached.
// Indexed by State.
using DistanceField = std::vector<Time>;

// Breadth-first search backwards from all of `targets`. O(states).
DistanceField distance_field(const World& world, std::span<const State> targets);
// From all states on `target`.
DistanceField distance_field(const World& world, Place target);

// The fields of all that any agent of an instance must reach: its tasks, and where to rest. Each
// is computed once. Immutable after construction; any thread may read it.
class DistanceFields {
 public:
  // Asks `limits` for the memory and looks at them between fields; if they strike, complete() is
  // false. Shares what `known` (null: nothing) has of the same map, as long as every state is its
  // place.
  explicit DistanceFields(const Instance& instance, const Limits& limits = Limits(),
                          const DistanceFields* known = nullptr);

  // All fields are there. If not, nothing must be asked for.
  bool complete() const { return complete_; }

  // To where the task is visited: a state on its place or, if it takes time, the end of the work.
  const DistanceField& to_task(TaskIndex task) const { return *by_task_[task]; }
  // The same in one heading, a port: the agent of that kind is there, or has done the work, looking
  // that way. Only if there are such fields: on worlds of moderate size in which agents turn.
  static constexpr int kPorts = 4;
  bool has_ports() const { return !by_port_.empty(); }
  const DistanceField& to_port(TaskIndex task, int kind, int port) const {
    return by_port_[(static_cast<std::size_t>(task) * kinds_ + kind) * kPorts + port];
  }
  // To where the agent may rest. Not of agents that rest on the last stop of their sequence.
  const DistanceField& to_rest(AgentIndex agent) const {
    GROVE_ASSERT(by_agent_[agent], "an agent that rests on its last stop has no other place");
    return *by_agent_[agent];
  }

 private:
  using FieldPtr = std::shared_ptr<const DistanceField>;
  FieldPtr field_to(Place place, const DistanceFields* known) const;

  std::shared_ptr<const Map> map_;     // null unless every state is its place
  std::map<Place, FieldPtr> to_place_;  // of that map
  std::vector<FieldPtr> fields_;
  std::vector<const DistanceField*> by_task_;
  std::vector<const DistanceField*> by_agent_;
  // By task, kind and heading; empty where no such agent has the task.
  std::vector<DistanceField> by_port_;
  std::size_t kinds_ = 1;
  bool complete_ = false;

  static constexpr State kMostStatesWithPorts = 1 << 16;
  bool add_ports(const Instance& instance, const Limits& limits);
};

// The least of the distances from the base states of one kind on a place.
Time least_from(const World& world, Place place, int kind, const DistanceField& distance);
// The greatest.
Time most_from(const World& world, Place place, int kind, const DistanceField& distance);

}  // namespace grove::detail
