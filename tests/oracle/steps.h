// SPDX-License-Identifier: MIT
// Where an agent can go in one step, read off a map: a second time, not from its world.
#pragma once

#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// By place: the places one move away; waits are not among them.
std::vector<std::vector<Place>> steps_on(const Map& map);

// The poses of this agent one step away from `pose`, on a map with these steps; waits are not among
// them.
std::vector<Pose> next_poses(const Instance& instance, const Agent& agent,
                             const std::vector<std::vector<Place>>& steps, const Pose& pose);

}  // namespace grove::detail::oracle
