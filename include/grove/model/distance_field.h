// SPDX-License-Identifier: MIT
// Shortest distances, ignoring other agents.
#pragma once

#include <memory>
#include <vector>

#include "grove/model/assert.h"
#include "grove/model/instance.h"
#include "grove/model/limits.h"

namespace grove {

// Distance in steps from every state to one place, in whatever state; kNever where it cannot be
// reached. Indexed by State.
using DistanceField = std::vector<Time>;

// Breadth-first search backwards from all states on `target`. O(states).
DistanceField distance_field(const World& world, Place target);

// The fields of all places that any agent of an instance must reach: tasks and destinations, each
// computed once. Immutable after construction; any thread may read it.
class DistanceFields {
 public:
  // Asks `limits` for the memory and looks at them between fields; if they strike, complete() is
  // false.
  explicit DistanceFields(const Instance& instance, const Limits& limits = Limits());

  // All fields are there. If not, to() must not be called.
  bool complete() const { return complete_; }

  // `target` must be the place of a task or of a destination.
  const DistanceField& to(Place target) const {
    GROVE_ASSERT(fields_[target], "distances are asked for to a task or a destination");
    return *fields_[target];
  }

 private:
  std::vector<std::unique_ptr<DistanceField>> fields_;  // by place; null where nobody must go
  bool complete_ = false;
};

}  // namespace grove
