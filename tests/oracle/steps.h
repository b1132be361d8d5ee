// SPDX-License-Identifier: MIT
// Moves of an agent, computed from the map. Independent of the library's World.
#pragma once

#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// Returns, for each place, the places that are one move away (waits excluded).
std::vector<std::vector<Place>> steps_on(const Map& map);

// Returns the poses of `agent` that are one step away from `pose` (waits excluded). `steps`: result
// of steps_on() for the map.
std::vector<Pose> next_poses(const Instance& instance, const Agent& agent,
                             const std::vector<std::vector<Place>>& steps, const Pose& pose);

}  // namespace grove::detail::oracle
