// SPDX-License-Identifier: MIT
// Steps of an agent, computed from the map. Independent of the library's World.
#pragma once

#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// For each place: the places one move away, without waits.
std::vector<std::vector<Place>> steps_on(const Map& map);

// The poses of `agent` one step away from `pose`, on a map with these steps, without waits.
std::vector<Pose> next_poses(const Instance& instance, const Agent& agent,
                             const std::vector<std::vector<Place>>& steps, const Pose& pose);

}  // namespace grove::detail::oracle
