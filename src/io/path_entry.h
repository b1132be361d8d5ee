// SPDX-License-Identifier: MIT
// Path entries, which are the positions of agents in files: on a grid [x, y]; for agents that turn
// [x, y, "N"], or [x, y, "N", "E", k] after k steps of a turn; on a roadmap ["A"], or ["A", "B", k]
// at k steps from A, with the number of the road as a fourth element if several roads join A and B
// (docs/design.md, section 5).
#pragma once

#include <nlohmann/json.hpp>

#include "io/json_value.h"
#include "model/instance.h"

namespace grove::detail {

// The read functions throw InputError, at `value` or an element of it, if it is not an entry of the
// required form for this map and motion, or if its place is not on the map. They accept blocked
// cells.
Pose read_pose(const Map& map, Motion motion, const JsonValue& value);
Heading read_heading(const JsonValue& value);

nlohmann::ordered_json pose_json(const Map& map, Motion motion, const Pose& pose);

// Reads the place of a vertex, written as ["A"] or "A".
Place read_vertex(const Roadmap& roadmap, const JsonValue& value);
// Reads the place of a start, written as a path entry or as the id of a vertex.
Place read_start(const Roadmap& roadmap, const JsonValue& value);

}  // namespace grove::detail
